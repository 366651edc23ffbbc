#include "tests/support/simulated_device.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <memory>
#include <random>

namespace hemitex::tests {
namespace {

using raster::SnappedPoint;
using raster::SnappedTriangle;
using raster::ViewVertex;

/// In [-1, 1].
double anyError(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-31 - 1; }
double anyError(std::minstd_rand& random) { return static_cast<double>(random()) * 0x1p-30 - 1; }

/// Seeded by the position, so that triangles which share a vertex get the same error. Seeding a std::mt19937 for each
/// vertex takes longer than drawing.
std::minstd_rand generatorOf(std::uint32_t seed, const glm::vec3& position) {
  std::seed_seq sequence{seed, std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
                         std::bit_cast<std::uint32_t>(position.z)};
  return std::minstd_rand(sequence);
}

/// A vertex of the list; in clip space there is no vertex stage that could err.
ViewVertex disturbed(const SimulatedDevice& device, const raster::Face& face, const raster::DrawList& list,
                     std::uint32_t index) {
  ViewVertex vertex = raster::viewedVertex(face, list, index);
  if (list.clipDepth != raster::ClipDepth::None) return vertex;
  const glm::vec3 position = list.positions[index];
  std::minstd_rand random = generatorOf(device.seed, position);
  const auto error = [&](const glm::vec3& row) {
    double sizes = 0;
    for (int k = 0; k < 3; ++k)
      sizes += std::abs(static_cast<double>(row[k])) *
               (std::abs(static_cast<double>(position[k])) + std::abs(static_cast<double>(face.eye[k])));
    return anyError(random) * device.profile.vertexError * 0x1p-24 * sizes;
  };
  vertex.x += error(face.x);
  vertex.y += error(face.y);
  vertex.w += error(face.w);
  if (device.vertex) device.vertex(vertex);
  return vertex;
}

raster::ClippedPolygon polygonOn(const SimulatedDevice& device, const raster::Face& face, const raster::DrawList& list,
                                 std::uint32_t t) {
  // The guard band is eight times the view. Scaled by eight, a triangle is clipped at the view instead.
  const double scale = device.cutsAtView ? 8 : 1;
  std::array<ViewVertex, 3> triangle;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t index = list.indices[3 * std::size_t{t} + k];
    triangle[k] = disturbed(device, face, list, index);
    triangle[k].x *= scale;
    triangle[k].y *= scale;
  }
  raster::ClippedPolygon polygon = raster::clip(triangle, face.nearDistance, list.clipDepth);
  for (std::size_t k = 0; k < polygon.count; ++k) {
    ViewVertex& vertex = polygon.vertices[k];
    vertex.x = vertex.x / scale + device.shift / (128.0 * raster::viewportOf(face).columns) * vertex.w;
    vertex.y /= scale;
  }
  return polygon;
}

double snapOn(const SimulatedDevice& device, double position) {
  // A staged device has integer corners; a thousandth of a sub-pixel of the rules stands for not snapping.
  const bool snaps = device.profile.snapRounding != reference::SnapRounding::None;
  const double unit = snaps ? std::ldexp(256.0, -device.profile.subpixelBits) : 0x1p-10;
  const bool nearest = device.profile.snapRounding != reference::SnapRounding::Truncate;
  return (nearest ? std::nearbyint(position / unit) : std::floor(position / unit)) * unit;
}

/// A depth as the device computes it and rounds it to its format, in total within the profile's error.
double storedDepth(const SimulatedDevice& device, double depth, std::mt19937& random) {
  const reference::DeviceProfile& profile = device.profile;
  const double computed =
      depth + anyError(random) * reference::depthError(profile) * std::max(0.0, 1 - 0.5 / profile.depthTolerance);
  const auto rounded = [computed](double largest) { return std::nearbyint(computed * largest) / largest; };
  switch (profile.depthFormat) {
    case reference::DepthFormat::Float32:
      return static_cast<float>(computed);
    case reference::DepthFormat::Unorm24:
      return rounded(0xffffff);
    case reference::DepthFormat::Unorm16:
      return rounded(0xffff);
  }
  return computed;
}

/// A plane equation in binary32 through the values at the corners, evaluated relative to the first corner.
float planeAt(const SnappedTriangle& triangle, const SnappedPoint& position, const glm::vec3& values) {
  const auto fromFirst = [&](const SnappedPoint& p) {
    return glm::vec2(p.x - triangle.corners[0].x, p.y - triangle.corners[0].y);
  };
  const glm::vec2 p = fromFirst(triangle.corners[1]), q = fromFirst(triangle.corners[2]), d = fromFirst(position);
  const float inverseArea = 1 / static_cast<float>(triangle.area);
  const float along = values[1] - values[0], across = values[2] - values[0];
  const float perColumn = (along * q.y - across * p.y) * inverseArea;
  const float perRow = (across * p.x - along * q.x) * inverseArea;
  return values[0] + perColumn * d.x + perRow * d.y;
}

float weightedAt(const SnappedTriangle& triangle, const SnappedPoint& position, const glm::vec3& values) {
  const raster::Weights edges = weightsAt(triangle, position);
  const float inverseArea = 1 / static_cast<float>(std::abs(triangle.area));
  float sum = 0;
  for (int k = 0; k < 3; ++k) sum += static_cast<float>(edges[static_cast<std::size_t>(k)]) * inverseArea * values[k];
  return sum;
}

glm::dvec2 texcoordIn32(const SnappedTriangle& triangle, const SnappedPoint& position, Interpolation interpolation) {
  glm::vec3 overW, u, v;
  for (int k = 0; k < 3; ++k) {
    const ViewVertex& vertex = triangle.vertices[static_cast<std::size_t>(k)];
    overW[k] = 1 / static_cast<float>(vertex.w);
    u[k] = static_cast<float>(vertex.u) * overW[k];
    v[k] = static_cast<float>(vertex.v) * overW[k];
  }
  const auto at = [&](const glm::vec3& values) {
    return interpolation == Interpolation::Planes32 ? planeAt(triangle, position, values)
                                                    : weightedAt(triangle, position, values);
  };
  const float w = 1 / at(overW);
  return {at(u) * w, at(v) * w};
}

glm::dvec2 texcoordOn(const SimulatedDevice& device, const SnappedTriangle& triangle, const SnappedPoint& position) {
  if (device.interpolation != Interpolation::Exact) return texcoordIn32(triangle, position, device.interpolation);
  const raster::Weights edges = weightsAt(triangle, position);
  const glm::dvec3 sum = device.affine ? reference::weightedSum(triangle, edges, [](double) { return 1.0; })
                                       : reference::weightedSum(triangle, edges);
  return glm::dvec2(sum) / sum.z;
}

/// The error of one rounding of interpolation: 2^-24 of the largest coordinate, times w / min w_k.
glm::dvec2 roundingAt(const SnappedTriangle& triangle, const SnappedPoint& position) {
  glm::dvec2 largest(0.0);
  double nearest = HUGE_VAL;
  for (const ViewVertex& vertex : triangle.vertices) {
    largest = glm::max(largest, glm::abs(glm::dvec2(vertex.u, vertex.v)));
    nearest = std::min(nearest, vertex.w);
  }
  return 0x1p-24 * largest / (nearest * coveredSample(triangle, weightsAt(triangle, position)).inverseDepth);
}

raster::ItemId fetchOn(const SimulatedDevice& device, const raster::IndexMap& map, const reference::Lookup& lookup,
                       std::mt19937& random) {
  const glm::dvec2 size = reference::sizeOf(map), rounding = roundingAt(lookup.triangle, lookup.position);
  glm::dvec2 texel = lookup.at * size + device.texelShift;
  if (device.interpolation != Interpolation::Exact) texel = glm::vec2(lookup.at) * glm::vec2(size);
  for (int axis = 0; axis < 2; ++axis)
    texel[axis] += anyError(random) *
                   (device.profile.texelPrecision + device.profile.interpolationError * rounding[axis] * size[axis]);
  return device.fetch ? device.fetch(map, texel) : reference::texelAt(map, texel);
}

}  // namespace

reference::StagedDevice stagedDeviceOf(const SimulatedDevice& device, const raster::DrawList& list) {
  const auto random = std::make_shared<std::mt19937>(device.seed);
  reference::StagedDevice stages;
  const bool snaps = device.profile.snapRounding != reference::SnapRounding::None;
  const std::int64_t fineness = std::int64_t{1} << (snaps ? std::max(0, device.profile.subpixelBits - 8) : 10);
  stages.geometry = {[=](const raster::Face& face, const raster::DrawList& drawn, std::uint32_t t) {
                       return polygonOn(device, face, drawn, t);
                     },
                     [=](double position) { return snapOn(device, position); }, fineness};
  if (device.bottomRight)
    stages.ownsSamples = [](const SnappedPoint& direction) { return !raster::ownsSamples(direction); };
  stages.samples = {device.sample};
  stages.shadingSample = device.shading;
  const bool isScene = list.clipDepth == raster::ClipDepth::None;
  stages.depth = [=, rule = raster::depthRuleOf(list, {})](double nearness, double nearDistance) {
    const double depth = isScene ? 1 - nearDistance * nearness : rule.offset - rule.scale * nearness;
    return storedDepth(device, depth, *random);
  };
  stages.passes = std::less<double>();
  stages.clearedDepth = list.depthTest >= raster::DepthTest::Farther ? 0 : 1;
  if (device.passes) {
    stages.passes = device.passes;
    stages.clearedDepth.reset();
  }
  stages.interpolate = [=](const SnappedTriangle& triangle, const SnappedPoint& position) {
    return texcoordOn(device, triangle, position);
  };
  stages.fetch = [=](const raster::DrawList& drawn, std::size_t map, const reference::Lookup& lookup) {
    return fetchOn(device, drawn.indexMaps[map], lookup, *random);
  };
  if (device.blend)
    stages.blend = [=](const raster::DrawList&, raster::ItemId offset, raster::ItemId texel) {
      return device.blend(offset, texel);
    };
  if (device.store) stages.store = device.store;
  return stages;
}

raster::ItemBuffer drawOn(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face) {
  reference::StagedDevice stages = stagedDeviceOf(device, list);
  raster::ItemBuffer drawn;
  stages.readBack = [&](const raster::Face&, raster::ItemBuffer& buffer) { drawn = buffer; };
  drawOn(stages, reference::PlacedVector{list, {face}, {{}}, {{}}, list},
         [](const raster::ItemBuffer&) { return true; });
  return drawn;
}

}  // namespace hemitex::tests
