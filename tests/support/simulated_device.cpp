#include "tests/support/simulated_device.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

namespace hemitex::tests {
namespace {

using raster::ViewVertex;

/// In [-1, 1].
double anyError(std::mt19937& random) { return static_cast<double>(random()) * 0x1p-31 - 1; }

/// Seeded by the position, so that triangles which share a vertex get the same error.
std::mt19937 generatorOf(std::uint32_t seed, const glm::vec3& position) {
  std::seed_seq sequence{seed, std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
                         std::bit_cast<std::uint32_t>(position.z)};
  return std::mt19937(sequence);
}

ViewVertex disturbed(const SimulatedDevice& device, const raster::Face& face, const glm::vec3& position,
                     const glm::vec2& texcoord) {
  ViewVertex vertex = raster::transform(face, position, texcoord);
  std::mt19937 random = generatorOf(device.seed, position);
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

raster::ClippedPolygon clipOn(const SimulatedDevice& device, std::array<ViewVertex, 3> triangle, double nearDistance) {
  // The guard band is eight times the view. Scaled by eight, a triangle is clipped at the view instead.
  const double scale = device.cutsAtView ? 8 : 1;
  for (ViewVertex& vertex : triangle) {
    vertex.x *= scale;
    vertex.y *= scale;
  }
  raster::ClippedPolygon polygon = raster::clip(triangle, nearDistance);
  for (ViewVertex& vertex : polygon.vertices) {
    vertex.x /= scale;
    vertex.y /= scale;
  }
  return polygon;
}

double snapOn(const SimulatedDevice& device, double q, int resolution) {
  const double unit = std::ldexp(256.0, -device.profile.subpixelBits);
  const double position = (q + 1) * 128 * resolution / unit;
  const bool nearest = device.profile.snapRounding == reference::SnapRounding::Nearest;
  return (nearest ? std::nearbyint(position) : std::floor(position)) * unit;
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

struct DevicePixel {
  bool isCovered = false;
  double depth = 0;
  raster::ItemId id = 0;
};

/// Pixels [first, end) of a scissor rectangle's side whose samples may lie between the smallest and the largest
/// position.
std::pair<int, int> pixelsBetween(double low, double high, int first, int size) {
  const double end = first + size;
  return {static_cast<int>(std::clamp(std::floor(low / 256), static_cast<double>(first), end)),
          static_cast<int>(std::clamp(std::ceil(high / 256), static_cast<double>(first), end))};
}

double cross(const glm::dvec2& p, const glm::dvec2& q) { return p.x * q.y - p.y * q.x; }

/// A triangle of a fan, snapped.
struct SnappedTriangle {
  std::array<ViewVertex, 3> vertices;
  std::array<glm::dvec2, 3> s;
  double area = 0;

  SnappedTriangle(const SimulatedDevice& device, const std::array<ViewVertex, 3>& fan, int resolution) : vertices(fan) {
    for (std::size_t k = 0; k < 3; ++k)
      s[k] = {snapOn(device, fan[k].x / fan[k].w, resolution) + device.shift,
              snapOn(device, fan[k].y / fan[k].w, resolution)};
    area = cross(s[1] - s[0], s[2] - s[0]);
  }

  /// The edge opposite vertex k, its interior on the right where rows grow downwards.
  glm::dvec2 along(std::size_t k) const { return (area > 0 ? 1.0 : -1.0) * (s[(k + 2) % 3] - s[(k + 1) % 3]); }

  double edgeAt(std::size_t k, const glm::dvec2& position) const { return cross(along(k), position - s[(k + 1) % 3]); }

  double inverseDepthAt(const glm::dvec2& position) const {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) sum += edgeAt(k, position) / std::abs(area) / vertices[k].w;
    return sum;
  }

  /// A plane equation in binary32 through the values at the corners, evaluated relative to the first corner.
  float planeAt(const glm::dvec2& position, const glm::vec3& values) const {
    const glm::vec2 p(s[1] - s[0]), q(s[2] - s[0]), d(position - s[0]);
    const float inverseArea = 1 / static_cast<float>(area);
    const float along = values[1] - values[0], across = values[2] - values[0];
    const float perColumn = (along * q.y - across * p.y) * inverseArea;
    const float perRow = (across * p.x - along * q.x) * inverseArea;
    return values[0] + perColumn * d.x + perRow * d.y;
  }

  float weightedAt(const glm::dvec2& position, const glm::vec3& values) const {
    const float inverseArea = 1 / static_cast<float>(std::abs(area));
    float sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += static_cast<float>(edgeAt(k, position)) * inverseArea * values[static_cast<int>(k)];
    return sum;
  }

  glm::dvec2 texcoordIn32(const glm::dvec2& position, Interpolation interpolation) const {
    glm::vec3 overW, u, v;
    for (int k = 0; k < 3; ++k) {
      const ViewVertex& vertex = vertices[static_cast<std::size_t>(k)];
      overW[k] = 1 / static_cast<float>(vertex.w);
      u[k] = static_cast<float>(vertex.u) * overW[k];
      v[k] = static_cast<float>(vertex.v) * overW[k];
    }
    const auto at = [&](const glm::vec3& values) {
      return interpolation == Interpolation::Planes32 ? planeAt(position, values) : weightedAt(position, values);
    };
    const float w = 1 / at(overW);
    return {at(u) * w, at(v) * w};
  }

  /// The error of one rounding of interpolation: 2^-24 of the largest coordinate, times w / min w_k.
  glm::dvec2 roundingAt(const glm::dvec2& position) const {
    glm::dvec2 largest(0.0);
    double nearest = HUGE_VAL;
    for (const ViewVertex& vertex : vertices) {
      largest = glm::max(largest, glm::abs(glm::dvec2(vertex.u, vertex.v)));
      nearest = std::min(nearest, vertex.w);
    }
    return 0x1p-24 * largest / (nearest * inverseDepthAt(position));
  }

  glm::dvec2 texcoordAt(const glm::dvec2& position, bool affine) const {
    double total = 0;
    glm::dvec2 sum(0.0);
    for (std::size_t k = 0; k < 3; ++k) {
      const double weight = edgeAt(k, position) / (affine ? 1 : vertices[k].w);
      total += weight;
      sum += weight * glm::dvec2(vertices[k].u, vertices[k].v);
    }
    return sum / total;
  }
};

bool covers(const SimulatedDevice& device, const SnappedTriangle& triangle, const glm::dvec2& sample) {
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 along = triangle.along(k);
    const double value = triangle.edgeAt(k, sample);
    const bool topOrLeft = along.y < 0 || (along.y == 0 && along.x > 0);
    if (value < 0 || (value == 0 && topOrLeft == device.bottomRight)) return false;
  }
  return true;
}

raster::ItemId fetch(const SimulatedDevice& device, const raster::IndexMap& map, const glm::dvec2& texcoord,
                     const glm::dvec2& rounding, std::mt19937& random) {
  const glm::dvec2 size(map.width, map.height);
  glm::dvec2 texel = texcoord * size + device.texelShift;
  if (device.interpolation != Interpolation::Exact) texel = glm::vec2(texcoord) * glm::vec2(size);
  for (int axis = 0; axis < 2; ++axis)
    texel[axis] += anyError(random) *
                   (device.profile.texelPrecision + device.profile.interpolationError * rounding[axis] * size[axis]);
  if (device.fetch) return device.fetch(map, texel);
  texel = glm::clamp(glm::floor(texel), glm::dvec2(0.0), size - 1.0);
  return map.ids[static_cast<std::size_t>(texel.y * size.x + texel.x)];
}

raster::ItemId shade(const SimulatedDevice& device, const raster::DrawList& list, const raster::Draw& draw,
                     bool facesAway, const glm::dvec2& texcoord, const glm::dvec2& rounding, std::mt19937& random) {
  if (facesAway && draw.back) return *draw.back;
  if (!draw.indexMap) return draw.offset;
  const raster::IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const raster::ItemId texel = fetch(device, map, texcoord, rounding, random);
  return device.blend ? device.blend(draw.offset, texel) : raster::blend(list.format, list.blend, draw.offset, texel);
}

void drawTriangle(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face,
                  const raster::Draw& draw, const std::array<ViewVertex, 3>& vertices, std::mt19937& random,
                  std::vector<DevicePixel>& pixels) {
  const SnappedTriangle triangle(device, vertices, face.resolution);
  if (triangle.area == 0) return;
  const bool facesAway = (triangle.area < 0) == (raster::determinant(face) < 0);
  const raster::Scissor& scissor = face.scissor;
  const auto& s = triangle.s;
  const auto [left, right] = std::minmax({s[0].x, s[1].x, s[2].x});
  const auto [top, bottom] = std::minmax({s[0].y, s[1].y, s[2].y});
  const auto [firstColumn, endColumn] = pixelsBetween(left, right, scissor.column, scissor.width);
  const auto [firstRow, endRow] = pixelsBetween(top, bottom, scissor.row, scissor.height);
  for (int row = firstRow; row < endRow; ++row)
    for (int column = firstColumn; column < endColumn; ++column) {
      const glm::dvec2 corner(256.0 * column, 256.0 * row);
      if (!covers(device, triangle, corner + device.sample)) continue;
      const double inverseDepth = triangle.inverseDepthAt(corner + device.sample);
      const double depth = storedDepth(device, 1 - static_cast<double>(face.nearDistance) * inverseDepth, random);
      DevicePixel& pixel =
          pixels[static_cast<std::size_t>(row - scissor.row) * static_cast<std::size_t>(scissor.width) +
                 static_cast<std::size_t>(column - scissor.column)];
      const bool passes = device.passes ? device.passes(depth, pixel.depth) : depth < pixel.depth;
      if (pixel.isCovered && !passes) continue;
      const glm::dvec2 shading = corner + device.shading;
      const glm::dvec2 texcoord = device.interpolation == Interpolation::Exact
                                      ? triangle.texcoordAt(shading, device.affine)
                                      : triangle.texcoordIn32(shading, device.interpolation);
      const raster::ItemId id = shade(device, list, draw, facesAway, texcoord, triangle.roundingAt(shading), random);
      pixel = {true, depth, device.store ? device.store(pixel.id, id) : id};
    }
}

/// The pixels of a scissor rectangle: background, and the depths of the target.
std::vector<DevicePixel> clearedPixels(const raster::Scissor& scissor, raster::ItemId background,
                                       const TargetDepths& depths) {
  std::vector<DevicePixel> pixels(static_cast<std::size_t>(scissor.width) * static_cast<std::size_t>(scissor.height),
                                  {false, 0, background});
  for (const auto& [place, depth] : depths) {
    const int column = place.first - scissor.column, row = place.second - scissor.row;
    if (column < 0 || row < 0 || column >= scissor.width || row >= scissor.height) continue;
    pixels[static_cast<std::size_t>(row * scissor.width + column)] = {true, depth, background};
  }
  return pixels;
}

void drawList(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face,
              std::vector<DevicePixel>& pixels) {
  std::mt19937 random(device.seed);
  for (const raster::Draw& draw : list.draws)
    for (std::uint32_t first = draw.first; first < draw.first + draw.count; first += 3) {
      std::array<ViewVertex, 3> corners;
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t index = list.indices[first + k];
        corners[k] = disturbed(device, face, list.positions[index], list.texcoords[index]);
      }
      const raster::ClippedPolygon polygon = clipOn(device, corners, static_cast<double>(face.nearDistance));
      for (std::size_t k = 2; k < static_cast<std::size_t>(polygon.count); ++k)
        drawTriangle(device, list, face, draw, {polygon.vertices[0], polygon.vertices[k - 1], polygon.vertices[k]},
                     random, pixels);
    }
}

raster::ItemBuffer bufferOf(const std::vector<DevicePixel>& pixels, const raster::Scissor& scissor) {
  raster::ItemBuffer buffer{scissor.width, scissor.height, {}};
  for (const DevicePixel& pixel : pixels) buffer.ids.push_back(pixel.id);
  return buffer;
}

}  // namespace

raster::ItemBuffer drawOn(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face) {
  std::vector<DevicePixel> pixels = clearedPixels(face.scissor, raster::backgroundId(list.format), {});
  drawList(device, list, face, pixels);
  return bufferOf(pixels, face.scissor);
}

raster::ItemBuffer drawOn(const SimulatedDevice& device, const raster::DrawList& list, const raster::Face& face,
                          TargetDepths& depths) {
  const raster::Scissor& scissor = face.scissor;
  std::vector<DevicePixel> pixels = clearedPixels(scissor, raster::backgroundId(list.format), depths);
  drawList(device, list, face, pixels);
  for (int row = 0, p = 0; row < scissor.height; ++row)
    for (int column = 0; column < scissor.width; ++column, ++p)
      if (const DevicePixel& pixel = pixels[static_cast<std::size_t>(p)]; pixel.isCovered)
        depths[{scissor.column + column, scissor.row + row}] = pixel.depth;
  return bufferOf(pixels, scissor);
}

}  // namespace hemitex::tests
