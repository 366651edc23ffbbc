#include "radiosity/textures/second_coordinates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "radiosity/geometry/chart_validation.h"
#include "radiosity/geometry/grid_clipping.h"
#include "radiosity/textures/file_names.h"
#include "raster/base/cross.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

using PlaneTriangle = std::array<glm::dvec2, 3>;

double area(const PlaneTriangle& triangle) {
  return std::abs(raster::cross(triangle[1] - triangle[0], triangle[2] - triangle[0])) / 2;
}

PlaneTriangle scaled(PlaneTriangle triangle, const glm::dvec2& factor) {
  for (glm::dvec2& corner : triangle) corner *= factor;
  return triangle;
}

/// The barycentric weights of the point of a triangle with area that is nearest to a place.
glm::dvec3 nearestWeights(const PlaneTriangle& triangle, const glm::dvec2& place) {
  if (const std::optional<glm::dvec2> inside = weightsAt(triangle, place))
    return {1 - inside->x - inside->y, inside->x, inside->y};
  glm::dvec3 nearest(0);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const auto from = static_cast<std::size_t>(k), to = (from + 1) % 3;
    const glm::dvec2 side = triangle[to] - triangle[from];
    const double t = std::clamp(glm::dot(place - triangle[from], side) / glm::dot(side, side), 0.0, 1.0);
    const glm::dvec2 apart = place - (triangle[from] + t * side);
    if (!(glm::dot(apart, apart) < least)) continue;  // a side without length gives NaN
    least = glm::dot(apart, apart);
    nearest = glm::dvec3(0);
    nearest[k] = 1 - t;
    nearest[static_cast<int>(to)] = t;
  }
  return nearest;
}

template <typename Corners>
auto mean(const Corners& corners, const glm::dvec3& weights) {
  return weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
}

/// A lit triangle in a light map, and in second coordinates; v = 0 is the top of both.
struct MovedTriangle {
  int lightMap = 0;
  PlaneTriangle from, to;
};

struct MovedLight {
  CodedImage texture;
  Image linear;
};

/// Interpolates light maps at the texels of a square texture. A texel has the light at the nearest point of the nearest
/// triangle, up to a distance of two texels.
MovedLight movedLight(const std::vector<MovedTriangle>& triangles, const FileLightMaps& lit) {
  constexpr double reach = 2;
  constexpr int smallest = 16, largest = 4096;
  double texels = 0, share = 0;
  for (const MovedTriangle& triangle : triangles) {
    const CodedImage& source = lit.textures[static_cast<std::size_t>(triangle.lightMap)];
    texels += area(scaled(triangle.from, {source.width, source.height}));
    share += area(triangle.to);
  }
  int side = smallest;
  while (side < largest && side * side * share < texels) side *= 2;
  const auto count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  std::vector<double> distance(count, reach * reach);
  const Sampler sampler{.wrap = {Wrap::Clamp, Wrap::Clamp}};
  Image shown{side, side, std::vector<glm::dvec3>(count, glm::dvec3(0)), sampler}, linear = shown;
  for (const MovedTriangle& triangle : triangles) {
    const PlaneTriangle to = scaled(triangle.to, glm::dvec2(side));
    const glm::dvec2 low = glm::max(glm::min(glm::min(to[0], to[1]), to[2]) - reach, 0.0),
                     high = glm::min(glm::max(glm::max(to[0], to[1]), to[2]) + reach, static_cast<double>(side));
    for (auto row = static_cast<int>(low.y); row < static_cast<int>(std::ceil(high.y)); ++row)
      for (auto column = static_cast<int>(low.x); column < static_cast<int>(std::ceil(high.x)); ++column) {
        const glm::dvec2 place(column + 0.5, row + 0.5);
        const glm::dvec3 weights = nearestWeights(to, place);
        const glm::dvec2 apart = place - mean(to, weights);
        const std::size_t texel =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(side) + static_cast<std::size_t>(column);
        if (!(glm::dot(apart, apart) < distance[texel])) continue;
        distance[texel] = glm::dot(apart, apart);
        const glm::dvec2 from = mean(triangle.from, weights), upwards(from.x, 1 - from.y);
        const auto source = static_cast<std::size_t>(triangle.lightMap);
        shown.pixels[texel] = bilinear(lit.textures[source], upwards);
        linear.pixels[texel] = bilinear(lit.linear[source], upwards);
      }
  }
  return {encodeSrgb(shown), std::move(linear)};
}

/// A part of the file with second coordinates, and the lit triangles of it.
struct LitImport {
  const ImportedPart* part;
  std::uint32_t firstPolygon;
  std::vector<GltfLitTriangle*> triangles;
};

std::array<glm::dvec3, 3> positionsOf(const ImportedPart& part, std::size_t triangle) {
  const std::uint32_t* const corners = &part.corners[3 * triangle];
  return {part.positions[corners[0]], part.positions[corners[1]], part.positions[corners[2]]};
}

PlaneTriangle coordinatesOf(const ImportedPart& part, std::size_t triangle) {
  const std::uint32_t* const corners = &part.corners[3 * triangle];
  return {part.secondCoords[corners[0]], part.secondCoords[corners[1]], part.secondCoords[corners[2]]};
}

glm::dvec3 normalOf(const std::array<glm::dvec3, 3>& p) { return glm::cross(p[1] - p[0], p[2] - p[0]); }

/// Why the second coordinates of a part are no chart of its lit triangles; empty if they are one.
std::string problemOf(const LitImport& lit) {
  std::map<std::uint32_t, std::pair<bool, bool>> sides;  // of a polygon: whether its front and its back are lit
  for (const GltfLitTriangle* const triangle : lit.triangles) {
    const glm::dvec3 front = normalOf(positionsOf(*lit.part, triangle->polygon - lit.firstPolygon));
    auto& [hasFront, hasBack] = sides[triangle->polygon];
    (glm::dot(front, normalOf(triangle->positions)) < 0 ? hasBack : hasFront) = true;
  }
  std::vector<std::uint32_t> numbers;
  std::vector<ChartTriangle> charts;
  for (const auto& [polygon, side] : sides) {
    numbers.push_back(polygon - lit.firstPolygon);
    if (side.first && side.second) return "both sides of triangle " + std::to_string(numbers.back() + 1) + " are lit";
    charts.push_back(roundedChart(coordinatesOf(*lit.part, numbers.back())));
  }
  const std::vector<ChartConflict> conflicts = chartConflicts(charts, 1);
  if (conflicts.empty()) return {};
  const std::string name = "triangle " + std::to_string(numbers[conflicts[0].triangle] + 1);
  switch (conflicts[0].kind) {
    case ChartConflict::Kind::Outside:
      return name + " leaves the unit square";
    case ChartConflict::Kind::NoArea:
      return name + " has no area in them";
    case ChartConflict::Kind::Overlap:
      break;
  }
  return name + " overlaps triangle " + std::to_string(numbers[conflicts[0].other] + 1);
}

/// Moves the lit triangles of a part to a new light map.
MovedLight moveToSecond(const LitImport& part, int lightMap, const FileLightMaps& lit) {
  std::vector<MovedTriangle> moved;
  for (GltfLitTriangle* const triangle : part.triangles) {
    const std::uint32_t number = triangle->polygon - part.firstPolygon;
    MovedTriangle& place = moved.emplace_back();
    place.lightMap = std::exchange(triangle->lightMap, lightMap);
    for (std::size_t k = 0; k < 3; ++k) {
      place.from[k] = triangle->lightMapCoords[k];
      place.to[k] =
          affineAt(positionsOf(*part.part, number), coordinatesOf(*part.part, number), triangle->positions[k]);
      triangle->lightMapCoords[k] = place.to[k];
    }
  }
  return movedLight(moved, lit);
}

/// The parts with second coordinates that have lit triangles.
std::vector<LitImport> litImports(const GltfImport& import, std::vector<GltfLitTriangle>& triangles) {
  std::map<std::uint32_t, std::vector<GltfLitTriangle*>> byPolygon;
  for (GltfLitTriangle& triangle : triangles) byPolygon[triangle.polygon].push_back(&triangle);
  std::vector<LitImport> parts;
  std::uint32_t first = 0;
  for (const ImportedPart& part : import.parts) {
    const auto end = first + static_cast<std::uint32_t>(part.corners.size() / 3);
    LitImport lit{&part, std::exchange(first, end), {}};
    if (part.secondCoords.empty()) continue;
    for (auto i = byPolygon.lower_bound(lit.firstPolygon); i != byPolygon.end() && i->first < end; ++i)
      lit.triangles.insert(lit.triangles.end(), i->second.begin(), i->second.end());
    if (!lit.triangles.empty()) parts.push_back(std::move(lit));
  }
  return parts;
}

}  // namespace

std::vector<std::string> useSecondCoordinates(const std::filesystem::path& file, FileLightMaps& lit) {
  GltfImport import;
  if (!readParts(file, import).problem.empty()) return {};
  const std::vector<LitImport> parts = litImports(import, lit.triangles);
  std::vector<std::string> names, reasons;
  for (const NamedLightMap& map : lit.maps) names.push_back(map.name);
  std::vector<LitImport> moved;
  for (const LitImport& part : parts) {
    const std::string name = import.nodes[static_cast<std::size_t>(part.part->node)].name;
    const std::string problem = problemOf(part);
    if (!problem.empty()) {
      reasons.push_back("TEXCOORD_1 of `" + name + "` is not used for its light map: " + problem);
      continue;
    }
    moved.push_back(part);
    names.push_back(name + "-texcoord-1");
  }
  if (moved.empty()) return reasons;
  names = uniqueFileNames(names);
  const std::size_t given = lit.maps.size();
  std::vector<MovedLight> light(moved.size());
  raster::parallelFor(moved.size(),
                      [&](std::size_t i) { light[i] = moveToSecond(moved[i], static_cast<int>(given + i), lit); });
  for (std::size_t i = 0; i < moved.size(); ++i) {
    NamedLightMap map{names[given + i], lit.maps.front().map, true};
    map.map.png = "lightmaps/" + map.name + ".png";
    map.map.exr = "lightmaps/" + map.name + ".exr";
    lit.maps.push_back(std::move(map));
    lit.textures.push_back(std::move(light[i].texture));
    lit.linear.push_back(std::move(light[i].linear));
  }
  return reasons;
}

}  // namespace hemitex::radiosity
