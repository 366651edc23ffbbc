#include "reference/conformance/diagnosis/staged_device.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "reference/conformance/trace/fragments.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

constexpr double subPixels = 256;  // per pixel

/// The clipped polygon of triangle t; empty if a value is not finite.
ClipPolygon polygonOf(const StagedGeometry& geometry, const raster::DrawList& list, const raster::Face& face,
                      std::uint32_t t) {
  ClipPolygon corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t index = list.indices[3 * std::size_t{t} + k];
    const ClipVertex& corner =
        corners.emplace_back(ClipVertex{geometry.transform(face, list.positions[index]), list.texcoords[index]});
    if (!std::isfinite(corner.position.x + corner.position.y + corner.position.z + corner.position.w) ||
        !std::isfinite(corner.texcoord.x + corner.texcoord.y))
      return {};
  }
  return geometry.clip(corners);
}

DeviceVertex place(const StagedGeometry& geometry, const ClipVertex& vertex, int resolution) {
  const glm::dvec4& p = vertex.position;
  DeviceVertex placed{{p.x, p.y, p.w, vertex.texcoord.x, vertex.texcoord.y}, {}, {}};
  for (int axis = 0; axis < 2; ++axis) {
    const double q = std::clamp(p[axis] / p.w, -raster::guardBand, raster::guardBand);
    placed.position[axis] = geometry.snap((q + 1) * 128 * resolution);
  }
  return placed;
}

/// The triangles of a list in draw order, without reach.
std::vector<DeviceTriangle> placeBy(const StagedGeometry& geometry, const raster::DrawList& list,
                                    const raster::Face& face) {
  const bool isMirrored = raster::determinant(face) < 0;
  std::vector<DeviceTriangle> triangles;
  for (const DrawnTriangle& drawn : drawnTriangles(list)) {
    const ClipPolygon polygon = polygonOf(geometry, list, face, drawn.triangle);
    for (std::size_t k = 2; k < polygon.size(); ++k) {
      DeviceTriangle triangle{};
      triangle.triangle = drawn.triangle;
      triangle.draw = drawn.draw;
      const std::array<std::size_t, 3> fan{0, k - 1, k};
      for (std::size_t j = 0; j < 3; ++j) triangle.vertices[j] = place(geometry, polygon[fan[j]], face.resolution);
      triangle.area = doubledArea(triangle.vertices);
      triangle.facesAway = (triangle.area < 0) == isMirrored;
      const auto isAhead = [](const DeviceVertex& vertex) { return vertex.view.w > 0; };
      // Without area, or where a position is not a number, there is nothing to draw.
      if (std::abs(triangle.area) > 0 && std::all_of(triangle.vertices.begin(), triangle.vertices.end(), isAhead))
        triangles.push_back(triangle);
    }
  }
  return triangles;
}

/// The functions of a triangle at a position. Edge k is opposite vertex k, positive inside and exact. Attributes are
/// quotients of sums of edges times vertex values.
struct Setup {
  std::array<glm::dvec2, 3> starts, directions;  ///< of the edges
  std::array<bool, 3> ownsEdge;
  glm::dvec3 inverseW;  ///< at the vertices, over the doubled area
  glm::dvec3 weights, u, v;

  bool covers(const glm::dvec3& values) const {
    for (int k = 0; k < 3; ++k)
      if (values[k] < 0 || (values[k] == 0 && !ownsEdge[static_cast<std::size_t>(k)])) return false;
    return true;
  }
  glm::dvec3 edgesAt(const glm::dvec2& position) const {
    const auto edge = [&](std::size_t k) { return cross(directions[k], position - starts[k]); };
    return {edge(0), edge(1), edge(2)};
  }
};

/// Pixels [first, end) of the scissor rectangle that may hold covered samples.
struct PixelBox {
  glm::ivec2 first, end;
};

PixelBox boxOf(const DeviceTriangle& triangle, const raster::Scissor& scissor) {
  const auto [low, high] = extentOf(triangle);
  return {glm::max(glm::ivec2(glm::floor(low / subPixels)) - 1, glm::ivec2(scissor.column, scissor.row)),
          glm::min(glm::ivec2(glm::floor(high / subPixels)) + 1,
                   glm::ivec2(scissor.column + scissor.width, scissor.row + scissor.height))};
}

Setup setUp(const StagedDevice& device, const DeviceTriangle& triangle) {
  Setup setup{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto i = static_cast<int>(k);
    const raster::ViewVertex& view = triangle.vertices[k].view;
    const glm::dvec2 &p = triangle.vertices[(k + 1) % 3].position, &q = triangle.vertices[(k + 2) % 3].position;
    setup.starts[k] = p;
    setup.directions[k] = (triangle.area > 0 ? 1.0 : -1.0) * (q - p);
    setup.ownsEdge[k] = device.ownsEdge(setup.directions[k]);
    setup.inverseW[i] = 1 / view.w / std::abs(triangle.area);
    setup.weights[i] = device.weight(view.w);
    setup.u[i] = setup.weights[i] * view.u;
    setup.v[i] = setup.weights[i] * view.v;
  }
  return setup;
}

/// Clamps coordinates to finite values: extrapolation to a sample outside of the triangle may give any quotient or NaN.
glm::dvec2 held(const glm::dvec2& coordinates) {
  constexpr double largest = 1e9;
  const auto hold = [=](double x) { return std::isnan(x) ? 0.0 : std::clamp(x, -largest, largest); };
  return {hold(coordinates.x), hold(coordinates.y)};
}

Lookup lookUp(const Setup& setup, const glm::dvec2& position) {
  const glm::dvec3 edges = setup.edgesAt(position);
  const double total = glm::dot(edges, setup.weights);
  const glm::dvec2 at = glm::dvec2(glm::dot(edges, setup.u), glm::dot(edges, setup.v)) / total;
  const auto change = [&](const glm::dvec2& pixel) {
    const glm::dvec3 steps = setup.edgesAt(position + pixel) - edges;
    return (glm::dvec2(glm::dot(steps, setup.u), glm::dot(steps, setup.v)) - at * glm::dot(steps, setup.weights)) /
           total;
  };
  return {held(at), held(change({subPixels, 0})), held(change({0, subPixels}))};
}

ItemId shade(const StagedDevice& device, const raster::DrawList& list, const raster::Draw& draw, Facing facing,
             const Setup& setup, const glm::dvec2& position) {
  if (facing == Facing::Back && draw.back) return *draw.back;
  if (!draw.indexMap) return draw.offset;
  const ItemId texel = device.fetch(list, static_cast<std::size_t>(*draw.indexMap), lookUp(setup, position));
  return device.blend(list, draw.offset, texel);
}

/// A sample of the target.
struct Sample {
  std::optional<double> depth;  ///< without one, any fragment passes
  ItemId id;
};

/// Draws a triangle into the samples of the view's scissor rectangle.
void drawTriangle(const StagedDevice& device, const raster::DrawList& list, const raster::Face& view,
                  const DeviceTriangle& triangle, std::vector<Sample>& target) {
  const PixelBox box = boxOf(triangle, view.scissor);
  if (box.first.x >= box.end.x || box.first.y >= box.end.y) return;
  const Facing facing = device.facing(triangle.facesAway ? Facing::Back : Facing::Front, view);
  if (facing == Facing::Culled) return;
  const Setup setup = setUp(device, triangle);
  for (int row = box.first.y; row < box.end.y; ++row)
    for (int column = box.first.x; column < box.end.x; ++column) {
      const glm::dvec2 corner(subPixels * column, subPixels * row);
      const int pixel = (row - view.scissor.row) * view.scissor.width + column - view.scissor.column;
      for (std::size_t s = 0; s < device.samples.size(); ++s) {
        const glm::dvec3 edges = setup.edgesAt(corner + device.samples[s]);
        if (!setup.covers(edges)) continue;
        Sample& sample = target[static_cast<std::size_t>(pixel) * device.samples.size() + s];
        const double depth = device.depth(glm::dot(edges, setup.inverseW), static_cast<double>(view.nearDistance));
        if (sample.depth && !device.passes(depth, *sample.depth)) continue;
        const ItemId fragment =
            shade(device, list, list.draws[triangle.draw], facing, setup, corner + device.shadingSample);
        sample = {depth, device.store(sample.id, fragment)};
      }
    }
}

std::vector<DeviceTriangle> placeFace(const StagedDevice& device, const raster::DrawList& list,
                                      const raster::Face& view) {
  if (device.geometry) return placeBy(*device.geometry, list, view);
  return placeTriangles(list, view, {}, false, [](const DeviceTriangle& triangle) { return triangle.area != 0; });
}

bool isSameView(const raster::Face& a, const raster::Face& b) {
  return a.eye == b.eye && a.x == b.x && a.y == b.y && a.w == b.w && a.nearDistance == b.nearDistance &&
         a.resolution == b.resolution;
}

/// Whether the draws take the same triangles in the same order.
bool haveSameTriangles(const raster::DrawList& a, const raster::DrawList& b) {
  return a.indices == b.indices && a.texcoords == b.texcoords &&
         std::equal(
             a.draws.begin(), a.draws.end(), b.draws.begin(), b.draws.end(),
             [](const raster::Draw& x, const raster::Draw& y) { return x.first == y.first && x.count == y.count; });
}

/// The view of face `f` through the device's camera.
raster::Face viewOf(const StagedDevice& device, const std::vector<raster::Face>& faces, std::size_t f) {
  if (!device.camera) return faces[f];
  raster::Face view = device.camera(faces, f);
  view.resolution = faces[f].resolution;
  view.scissor = faces[f].scissor;
  return view;
}

/// The depths of samples that stay in the target, by column, row, and number in the pixel.
using KeptDepths = std::map<std::array<int, 3>, double>;

/// Draws the pixels of the view's scissor rectangle. `kept` is the memory of a device that keeps depths.
raster::ItemBuffer drawFace(const StagedDevice& device, const raster::DrawList& list, const raster::Face& view,
                            const std::vector<DeviceTriangle>& triangles, KeptDepths& kept) {
  raster::ItemBuffer buffer;
  buffer.resize(view.scissor);
  const std::size_t perPixel = device.samples.size();
  std::vector<Sample> target(buffer.ids.size() * perPixel, {{}, raster::backgroundId(list.format)});
  const auto placeOf = [&](std::size_t sample) {
    const glm::ivec2 pixel = pixelAt(view.scissor, sample / perPixel);
    return std::array{pixel.x, pixel.y, static_cast<int>(sample % perPixel)};
  };
  for (std::size_t s = 0; s < target.size() && !kept.empty(); ++s)
    if (const auto place = kept.find(placeOf(s)); place != kept.end()) target[s].depth = place->second;
  for (const DeviceTriangle& triangle : triangles) drawTriangle(device, list, view, triangle, target);
  for (std::size_t s = 0; s < target.size() && device.keepsDepth; ++s)
    if (target[s].depth) kept[placeOf(s)] = *target[s].depth;
  std::vector<ItemId> ids(perPixel);
  for (std::size_t pixel = 0; pixel < buffer.ids.size(); ++pixel) {
    for (std::size_t s = 0; s < perPixel; ++s) ids[s] = target[pixel * perPixel + s].id;
    buffer.ids[pixel] = device.resolve(ids);
  }
  return buffer;
}

}  // namespace

glm::dvec4 transformByRules(const raster::Face& face, const glm::vec3& position) {
  const raster::ViewVertex vertex = raster::transform(face, position, {0, 0});
  return {vertex.x, vertex.y, vertex.w - static_cast<double>(face.nearDistance), vertex.w};
}

ClipPolygon clipByRules(const ClipPolygon& polygon) {
  return clipAtSides(raster::guardBand, clipAt({0, 0, 1, 0}, polygon));
}

ClipPolygon clipAt(const glm::dvec4& plane, const ClipPolygon& polygon) {
  ClipPolygon clipped;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const ClipVertex &start = polygon[k], &end = polygon[(k + 1) % polygon.size()];
    const double atStart = glm::dot(plane, start.position), atEnd = glm::dot(plane, end.position);
    if (atStart >= 0) clipped.push_back(start);
    if ((atStart >= 0) == (atEnd >= 0)) continue;
    // From the inside end, so that two triangles that share the edge get the same point.
    const bool isStartInside = atStart >= 0;
    const ClipVertex &inside = isStartInside ? start : end, &outside = isStartInside ? end : start;
    const double atInside = isStartInside ? atStart : atEnd, atOutside = isStartInside ? atEnd : atStart;
    const double t = atInside / (atInside - atOutside);
    clipped.push_back({inside.position + t * (outside.position - inside.position),
                       inside.texcoord + t * (outside.texcoord - inside.texcoord)});
  }
  return clipped;
}

ClipPolygon clipAtSides(double size, ClipPolygon polygon) {
  for (const int axis : {0, 1})
    for (const double sign : {-1.0, 1.0}) {
      glm::dvec4 plane(0, 0, 0, size);
      plane[axis] = sign;
      polygon = clipAt(plane, polygon);
    }
  return polygon;
}

ItemId texelAt(const raster::IndexMap& map, const glm::dvec2& position) {
  return map
      .ids[texelAt(position.y, map.height) * static_cast<std::size_t>(map.width) + texelAt(position.x, map.width)];
}

ItemId nearestTexel(const raster::IndexMap& map, const glm::dvec2& at) { return texelAt(map, at * sizeOf(map)); }

StagedDevice withReadBack(const ReadBack& readBack) {
  StagedDevice device;
  device.readBack = readBack;
  device.isDrawnByRules = true;
  return device;
}

PlacedVector placeVector(const TestVector& vector) {
  PlacedVector placed{vector.list, facesOf(vector), {}, {}};
  const StagedDevice device;
  KeptDepths kept;
  for (const VectorFace& face : vector.faces) {
    placed.triangles.push_back(placeFace(device, vector.list, face.face));
    placed.buffers.push_back(drawFace(device, vector.list, face.face, placed.triangles.back(), kept));
  }
  return placed;
}

void drawOn(const StagedDevice& device, const PlacedVector& placed,
            const std::function<bool(const raster::ItemBuffer&)>& wantsMore) {
  constexpr int stripRows = 8;
  raster::DrawList changed;
  if (device.upload) device.upload(changed = placed.list);
  const raster::DrawList& list = device.upload ? changed : placed.list;
  const bool isSameMesh = !device.geometry && (!device.upload || haveSameTriangles(list, placed.list));
  KeptDepths kept;
  for (std::size_t f = 0; f < placed.faces.size(); ++f) {
    raster::Face view = viewOf(device, placed.faces, f);
    const bool isPlaced = isSameMesh && isSameView(view, placed.faces[f]);
    const std::vector<DeviceTriangle> moved = isPlaced ? std::vector<DeviceTriangle>{} : placeFace(device, list, view);
    const std::vector<DeviceTriangle>& triangles = isPlaced ? placed.triangles[f] : moved;
    if (device.readBack) {
      raster::ItemBuffer buffer =
          device.isDrawnByRules ? placed.buffers[f] : drawFace(device, list, view, triangles, kept);
      device.readBack(view, buffer);
      if (!wantsMore(buffer)) return;
      continue;
    }
    const int endRow = view.scissor.row + view.scissor.height;
    for (; view.scissor.row < endRow; view.scissor.row += stripRows) {
      view.scissor.height = std::min(stripRows, endRow - view.scissor.row);
      if (!wantsMore(drawFace(device, list, view, triangles, kept))) return;
    }
  }
}

}  // namespace hemitex::reference
