/// Faults of indices, the vertex transformation, clipping and snapping.
#include <algorithm>
#include <cmath>

#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::Face;

/// A device with one changed stage of its geometry.
template <typename Stage, typename Change>
StagedDevice withGeometry(Stage StagedGeometry::*stage, const Change& change) {
  StagedGeometry geometry;
  geometry.*stage = change;
  return withStage(&StagedDevice::geometry, geometry);
}

ClipPolygon clipAtNear(const ClipPolygon& polygon) { return clipAt({0, 0, 1, 0}, polygon); }

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

/// A 4x4 matrix from positions to clip coordinates; each row ends with its translation. The device clips z to [0, w].
Variant withTransposedMatrix(const std::string& name, glm::dvec4 (*depthRow)(const Face&)) {
  StagedGeometry geometry;
  geometry.transform = [=](const Face& face, const glm::vec3& position) {
    const auto row = [&](const glm::vec3& axis) { return glm::dvec4(axis, -glm::dot(axis, face.eye)); };
    const glm::dvec4 p(position, 1);
    return p.x * row(face.x) + p.y * row(face.y) + p.z * depthRow(face) + p.w * row(face.w);
  };
  geometry.clip = [](const ClipPolygon& polygon) {
    return clipAtSides(raster::guardBand, clipAt({0, 0, -1, 1}, clipAtNear(polygon)));
  };
  return {name, withStage(&StagedDevice::geometry, geometry)};
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

Variant withSidesAt(const std::string& name, double size) {
  const auto clip = [=](const ClipPolygon& polygon) { return clipAtSides(size, clipAtNear(polygon)); };
  return {name, withGeometry(&StagedGeometry::clip, clip)};
}

Variant withNearPlaneAt(const std::string& name, double distances) {
  const auto transform = [=](const Face& face, const glm::vec3& position) {
    glm::dvec4 p = transformByRules(face, position);
    p.z = p.w - distances * static_cast<double>(face.nearDistance);
    return p;
  };
  return {name, withGeometry(&StagedGeometry::transform, transform)};
}

/// Triangles that cross the near plane are left out.
Variant withoutCutTriangles() {
  const auto clip = [](const ClipPolygon& polygon) {
    const auto isBehind = [](const ClipVertex& vertex) { return vertex.position.z < 0; };
    return std::any_of(polygon.begin(), polygon.end(), isBehind) ? ClipPolygon{} : clipByRules(polygon);
  };
  return {"triangles that cross the near plane left out", withGeometry(&StagedGeometry::clip, clip)};
}

// --- snapping ---

std::vector<Variant> coarseGrids() {
  std::vector<Variant> variants;
  for (const int bits : {0, 1, 2, 3, 4, 5, 6})
    for (const bool isNearest : {true, false}) {
      const double unit = std::ldexp(256.0, -bits);
      const auto snap = [=](double position) {
        return unit * (isNearest ? std::nearbyint(position / unit) : std::floor(position / unit));
      };
      variants.push_back({std::to_string(bits) + " bits, " + (isNearest ? "rounded to nearest" : "truncated"),
                          withGeometry(&StagedGeometry::snap, snap)});
    }
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
      {"vertices snapped to fewer bits",
       "hardware with fewer sub-pixel bits is right: measure its profile; otherwise look for rounded positions",
       coarseGrids()}};
}

}  // namespace hemitex::reference
