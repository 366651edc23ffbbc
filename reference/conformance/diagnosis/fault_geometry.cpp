/// Faults of indices, the vertex transformation, clipping and snapping.
#include <algorithm>
#include <cmath>
#include <string>

#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::Face;
using raster::ViewVertex;

/// Clips a polygon at |x| = size w and |y| = size w.
raster::ClippedPolygon clippedAtSides(double size, raster::ClippedPolygon polygon) {
  // At the guard band, once its vertices are as much farther out.
  const double scale = raster::guardBand / size;
  const auto stretch = [&](double factor) {
    for (std::size_t k = 0; k < polygon.count; ++k) {
      polygon.vertices[k].x *= factor;
      polygon.vertices[k].y *= factor;
    }
  };
  stretch(scale);
  for (const raster::ClipPlane plane : raster::clipPlanes(raster::ClipDepth::None))
    if (plane != raster::ClipPlane::Near) polygon = raster::clip(polygon, plane, 0);
  stretch(1 / scale);
  return polygon;
}

/// A device with one changed stage of its geometry.
template <typename Stage, typename Change>
StagedDevice withGeometry(Stage StagedGeometry::*stage, const Change& change) {
  StagedGeometry geometry;
  geometry.*stage = change;
  return withStage(&StagedDevice::geometry, geometry);
}

// --- indices ---

Variant withIndicesOf(int bits) {
  const auto cut = [=](raster::DrawList& list) {
    for (std::uint32_t& index : list.indices) index &= (std::uint32_t{1} << bits) - 1;
  };
  return {std::to_string(bits) + " bits", withStage(&StagedDevice::upload, cut)};
}

// --- transformation ---

/// The rows X, Y and W of the view as columns; the eye is subtracted before.
StagedDevice withRowsAsColumns() {
  return withStage(&StagedDevice::camera, [](std::span<const Face> faces, std::size_t f) {
    Face face = faces[f];
    face.x = {faces[f].x.x, faces[f].y.x, faces[f].w.x};
    face.y = {faces[f].x.y, faces[f].y.y, faces[f].w.y};
    face.w = {faces[f].x.z, faces[f].y.z, faces[f].w.z};
    return face;
  });
}

/// A vertex in clip coordinates x, y, z, w.
struct ClipVertex {
  glm::dvec4 position;
  glm::dvec2 texcoord;
};

/// The part of a polygon where dot(plane, position) >= 0.
std::vector<ClipVertex> clipAt(const glm::dvec4& plane, const std::vector<ClipVertex>& polygon) {
  std::vector<ClipVertex> clipped;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ClipVertex &start = polygon[k], &end = polygon[(k + 1) % polygon.size()];
    const double atStart = glm::dot(plane, start.position), atEnd = glm::dot(plane, end.position);
    if (atStart >= 0) clipped.push_back(start);
    if ((atStart >= 0) == (atEnd >= 0)) continue;
    // From the inside end, so that two triangles that share the edge get the same point.
    const ClipVertex &inside = atStart >= 0 ? start : end, &outside = atStart >= 0 ? end : start;
    const double t = std::max(atStart, atEnd) / std::abs(atStart - atEnd);
    clipped.push_back({inside.position + t * (outside.position - inside.position),
                       inside.texcoord + t * (outside.texcoord - inside.texcoord)});
  }
  return clipped;
}

/// A 4x4 matrix from positions to clip coordinates; each row ends with its translation. The device clips z to [0, w].
Variant withTransposedMatrix(const std::string& name, glm::dvec4 (*depthRow)(const Face&)) {
  const auto polygon = [=](const Face& face, const raster::DrawList& list, std::uint32_t t) {
    const auto row = [&](const glm::vec3& axis) { return glm::dvec4(axis, -glm::dot(axis, face.eye)); };
    std::vector<ClipVertex> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t index = list.indices[3 * std::size_t{t} + k];
      const glm::dvec3 p = list.positions[index];
      const glm::dvec4 at = p.x * row(face.x) + p.y * row(face.y) + p.z * depthRow(face) + row(face.w);
      corners.push_back({at, list.texcoords[index]});
      if (!raster::isFinite({at.x, at.y, at.z + at.w, corners[k].texcoord.x, corners[k].texcoord.y}))
        return raster::ClippedPolygon{};
    }
    raster::ClippedPolygon clipped;
    for (const ClipVertex& vertex : clipAt({0, 0, -1, 1}, clipAt({0, 0, 1, 0}, corners))) {
      const glm::dvec4& p = vertex.position;
      clipped.add({p.x, p.y, p.w, vertex.texcoord.x, vertex.texcoord.y});
    }
    return clippedAtSides(raster::guardBand, clipped);
  };
  return {name, withGeometry(&StagedGeometry::polygon, polygon)};
}

std::vector<Variant> transposedMatrices() {
  return {
      {"3 x 3", withRowsAsColumns()},
      withTransposedMatrix("4 x 4 with z = n", [](const Face& face) { return glm::dvec4(0, 0, 0, face.nearDistance); }),
      withTransposedMatrix("4 x 4 with z = w - n", [](const Face& face) {
        return glm::dvec4(face.w, -glm::dot(face.w, face.eye) - face.nearDistance);
      })};
}

// --- clipping ---

using Clip = std::function<raster::ClippedPolygon(const std::array<ViewVertex, 3>&, double)>;

/// Clips the triangles of the rules in its own way.
Variant withClip(const std::string& name, const Clip& clip) {
  const auto polygon = [=](const Face& face, const raster::DrawList& list, std::uint32_t t) {
    const std::array<ViewVertex, 3> vertices = raster::view(face, list, t);
    return raster::areFinite(vertices) ? clip(vertices, face.nearDistance) : raster::ClippedPolygon{};
  };
  return {name, withGeometry(&StagedGeometry::polygon, polygon)};
}

Variant withSidesAt(const std::string& name, double size) {
  return withClip(name, [=](std::array<ViewVertex, 3> triangle, double nearDistance) {
    return clippedAtSides(size, raster::clip(triangle, nearDistance));
  });
}

Variant withNearPlaneAt(const std::string& name, double distances) {
  return withClip(name, [=](const std::array<ViewVertex, 3>& triangle, double nearDistance) {
    return raster::clip(triangle, distances * nearDistance);
  });
}

/// Clips at w = distance as well.
std::vector<Variant> farPlanes() {
  std::vector<Variant> variants;
  for (const bool isRelative : {false, true})
    for (const double distance : {10.0, 100.0, 1000.0}) {
      const auto clip = [=](const std::array<ViewVertex, 3>& triangle, double nearDistance) {
        const double far = isRelative ? distance * nearDistance : distance;
        std::vector<ClipVertex> inside;
        for (const ViewVertex& v : raster::clip(triangle, nearDistance))
          inside.push_back({{v.x, v.y, far, v.w}, {v.u, v.v}});
        raster::ClippedPolygon clipped;
        for (const ClipVertex& v : clipAt({0, 0, 1, -1}, inside))
          clipped.add({v.position.x, v.position.y, v.position.w, v.texcoord.x, v.texcoord.y});
        return clipped;
      };
      const std::string name = "at " + std::to_string(static_cast<int>(distance));
      variants.push_back(withClip(name + (isRelative ? " near distances" : ""), clip));
    }
  return variants;
}

/// Triangles that cross the near plane are left out.
Variant withoutCutTriangles() {
  return withClip("triangles that cross the near plane left out",
                  [](const std::array<ViewVertex, 3>& triangle, double nearDistance) {
                    const bool isCut = raster::cuts(raster::ClipPlane::Near, triangle, nearDistance);
                    return isCut ? raster::ClippedPolygon{} : raster::clip(triangle, nearDistance);
                  });
}

// --- snapping ---

std::vector<Variant> coarseGrids() {
  std::vector<Variant> variants;
  for (const int bits : {0, 1, 2, 3, 4, 5, 6})
    for (const bool isNearest : {true, false})
      variants.push_back({std::to_string(bits) + " bits, " + (isNearest ? "rounded to nearest" : "truncated"),
                          withStage(&StagedDevice::geometry, snappedTo(bits, isNearest))});
  return variants;
}

}  // namespace

std::vector<Fault> geometryFaults(const TestVector&) {
  return {
      {"indices cut to fewer bits",
       "pass indices of 32 bits: a vector may have more than 65,536 vertices",
       {withIndicesOf(8), withIndicesOf(16)}},
      {"matrix transposed",
       "x, y and w are dot products with the rows X, Y and W: look at the order in which the matrix is stored",
       transposedMatrices()},
      {"clipping at other planes",
       "clip at w = n, and beside the view at the guard band: look at the range of z, at the near distance, and at "
       "hardware that clips at the sides of the view",
       {withSidesAt("at the sides of the view", 1), withSidesAt("at twice the view", 2),
        withNearPlaneAt("near plane at half the distance", 0.5), withNearPlaneAt("near plane at twice the distance", 2),
        withNearPlaneAt("no near plane", 0x1p-10), withoutCutTriangles()}},
      {"far plane", "item buffers have no far plane: choose z so that z/w stays in its range at any distance",
       farPlanes()},
      {"vertices snapped to fewer bits",
       "hardware with fewer sub-pixel bits is right: measure its profile; otherwise look for rounded positions",
       coarseGrids()}};
}

}  // namespace hemitex::reference
