#include "radiosity/discretization/grid_size.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "radiosity/geometry/mesh_charts.h"
#include "radiosity/geometry/rectangle_packing.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::radiosity {
namespace {

/// The lengths of the two chart axes on the surface, |dP/du| and |dP/dv|, averaged by area.
glm::dvec2 chartLengths(const Surface& surface) {
  glm::dvec2 sum(0);
  double totalArea = 0;
  for (const Triangle& triangle : surface.triangles) {
    const glm::dvec3 p1 = triangle.position[1] - triangle.position[0], p2 = triangle.position[2] - triangle.position[0];
    const glm::dvec2 c1 = triangle.chart[1] - triangle.chart[0], c2 = triangle.chart[2] - triangle.chart[0];
    const double determinant = c1.x * c2.y - c1.y * c2.x;
    if (determinant == 0) continue;
    const double weight = area(triangle);
    sum += weight * glm::dvec2(glm::length(c2.y * p1 - c1.y * p2), glm::length(c1.x * p2 - c2.x * p1)) /
           std::abs(determinant);
    totalArea += weight;
  }
  return totalArea > 0 ? sum / totalArea : sum;
}

/// Minimum of columns and rows of a surface that is not flat, if texels follow the scene, because its faces have
/// different orientations.
constexpr int fewestOfBent = 4;

/// The angle in radians by which a curved surface turns within a texel, if texels follow the scene. Then the error of a
/// diffuse ball beside a wall is below 1 % of the mean (see tests/system/ball_test.cpp).
constexpr double turnPerTexel = 0.06;

/// Texels of curved surfaces are not smaller than this share of the others, so that small round parts stay cheap.
constexpr double smallestOfCurved = 0.25;

/// The power of two nearest to a number by ratio.
double nearestPowerOfTwo(double number) {
  double power = 1;
  while (2 * power * power < number * number) power *= 2;
  return power;
}

/// Whether all triangles have the same normal within the tolerance of planar parts.
bool isFlat(const Surface& surface) {
  const glm::dvec3 first = normal(surface.triangles.front());
  return std::all_of(surface.triangles.begin(), surface.triangles.end(),
                     [&](const Triangle& triangle) { return areParallel(first, normal(triangle)); });
}

/// The angle in radians by which the normals of a surface turn from one side to the other: twice the half-angle of the
/// cap of a sphere whose normals differ as much from their mean.
double turnOfNormals(const Surface& surface) {
  glm::dvec3 sum(0);
  double total = 0;
  for (const Triangle& triangle : surface.triangles) {
    sum += area(triangle) * normal(triangle);
    total += area(triangle);
  }
  // The mean over the normals of 1 - cos to the mean normal is a quarter of the squared half-angle of a small cap.
  return 4 * std::sqrt(std::max(0.0, 1 - glm::length(sum) / total));
}

/// The texel size on a curved surface whose longer side is given, if texels follow the scene.
double texelSizeOfCurved(const Surface& surface, double longerSide, double texelSize) {
  const double bySize = longerSide * turnPerTexel / turnOfNormals(surface);
  return std::clamp(bySize, smallestOfCurved * texelSize, texelSize);
}

/// The number of texels of at most the texel size along an axis. The factor allows for the rounding of charts to
/// binary32.
int texelsAlong(double length, const DiscretizationSettings& settings) {
  const double texels = std::ceil(length / *settings.texelSize * (1 - 1e-6));
  return static_cast<int>(std::clamp(texels, 1.0, static_cast<double>(settings.maxTexels)));
}

/// The size that the settings give this surface, or null.
const GridSize* namedSize(const Surface& surface, const DiscretizationSettings& settings) {
  for (const std::string& name : {surface.name, surface.family})
    if (const auto found = settings.surfaceTexels.find(name); found != settings.surfaceTexels.end())
      return &found->second;
  return nullptr;
}

/// The size if texels follow the scene: powers of two.
GridSize sizeFollowingScene(const Surface& surface, const glm::dvec2& lengths, const DiscretizationSettings& settings) {
  const int fewest = isFlat(surface) ? 1 : fewestOfBent;
  const double texelSize = surface.curvedPart
                               ? texelSizeOfCurved(surface, std::max(lengths.x, lengths.y), *settings.texelSize)
                               : *settings.texelSize;
  const auto along = [&](double length) {
    const auto texels = static_cast<int>(nearestPowerOfTwo(std::min(length / texelSize, 0x1p12)));
    return std::min(std::max(texels, fewest), settings.maxTexels);
  };
  return {along(lengths.x), along(lengths.y)};
}

/// Whether light changes across a strip of this width, because another front is nearer to it than that: to at least
/// half of some points, along the normal.
bool isFacedNear(const Surface& surface, double width, const RayTree& tree, double height) {
  constexpr std::size_t mostTriangles = 8;
  const std::vector<Triangle>& triangles = surface.triangles;
  const std::size_t step = (triangles.size() + mostTriangles - 1) / mostTriangles;
  int points = 0, faced = 0;
  for (std::size_t t = 0; t < triangles.size(); t += step) {
    const auto& [a, b, c] = triangles[t].position;
    const glm::dvec3 out = normal(triangles[t]);
    for (const glm::dvec3& corner : {a, b, c}) {
      const auto hit = tree.firstHit((a + b + c) / 6.0 + 0.5 * corner + height * out, out);
      ++points;
      if (hit && hit->isFront && hit->distance <= width) ++faced;
    }
  }
  return 2 * faced >= points;
}

/// A strip has one row or column of texels, and at least this number along it.
constexpr int shortestStrip = 4;

/// Gives strips that are faced near two texels across, if texels follow the scene: with one, the light that falls on
/// one edge would leave from the other one.
void widenStrips(const Scene& scene, const DiscretizationSettings& settings, std::vector<GridSize>& sizes) {
  std::optional<RayTree> tree;
  for (std::size_t s = 0; s < sizes.size(); ++s) {
    const auto [least, most] = std::minmax(sizes[s].columns, sizes[s].rows);
    const Surface& surface = scene.surfaces[s];
    const int one = settings.subdivision;
    if (least > one || most < shortestStrip * one || namedSize(surface, settings)) continue;
    if (!tree) tree.emplace(scene);
    const glm::dvec2 lengths = chartLengths(surface);
    if (!isFacedNear(surface, std::min(lengths.x, lengths.y), *tree, contactTolerance(scene))) continue;
    (sizes[s].columns == one ? sizes[s].columns : sizes[s].rows) = 2 * one;
  }
}

int subdivided(int texels, int subdivision) {
  return static_cast<int>(std::min<std::int64_t>(largestGrid, std::int64_t{texels} * subdivision));
}

bool fit(const Scene& scene, const DiscretizationSettings& settings, int pages, int side) {
  std::vector<RectangleSize> sizes;
  for (const Surface& surface : scene.surfaces) {
    const GridSize size = gridSizeOf(surface, settings);
    if (std::max(size.columns, size.rows) > side) return false;
    sizes.push_back({size.columns, size.rows});
  }
  return packRectangles(sizes, side).pages.size() <= static_cast<std::size_t>(pages);
}

/// The number of surfaces without those that walls separate from another (see separatedAtWalls): a part of one polygon
/// of the same family, which faces the same way, belongs to an earlier surface.
std::size_t countOfWholes(const Scene& scene) {
  const Families families = familiesOf(scene);
  std::size_t count = 0;
  for (const std::vector<std::uint32_t>& surfaces : families.surfaces) {
    std::multimap<std::uint32_t, glm::dvec3> normals;  // by polygon, of earlier surfaces
    for (const std::uint32_t s : surfaces) {
      const std::vector<Triangle>& triangles = scene.surfaces[s].triangles;
      const auto isKnown = [&](const Triangle& triangle) {
        const auto [begin, end] = normals.equal_range(triangle.polygon);
        return std::any_of(begin, end, [&](const auto& known) { return areParallel(known.second, normal(triangle)); });
      };
      if (surfaces.size() == 1 || std::none_of(triangles.begin(), triangles.end(), isKnown)) ++count;
      if (surfaces.size() > 1)
        for (const Triangle& triangle : triangles) normals.emplace(triangle.polygon, normal(triangle));
    }
  }
  return count;
}

}  // namespace

DiscretizationSettings followingScene(const Scene& scene, DiscretizationSettings settings) {
  if (settings.texels || settings.texelSize) return settings;
  constexpr double elementsPerSurface = 90, maxElements = 0x1p16;
  constexpr int maxTexels = 64;
  double sum = 0;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) sum += area(triangle);
  const double elements = std::min(elementsPerSurface * static_cast<double>(countOfWholes(scene)), maxElements);
  settings.texelSize = std::sqrt(sum / elements);
  settings.powersOfTwo = true;
  settings.maxTexels = maxTexels;
  return settings;
}

GridSize gridSizeOf(const Surface& surface, const DiscretizationSettings& settings) {
  if (const GridSize* named = namedSize(surface, settings)) return *named;
  GridSize size;
  if (settings.texelSize) {
    const glm::dvec2 lengths = chartLengths(surface);
    size = settings.powersOfTwo ? sizeFollowingScene(surface, lengths, settings)
                                : GridSize(texelsAlong(lengths.x, settings), texelsAlong(lengths.y, settings));
  } else {
    size = *settings.texels;
  }
  return {subdivided(size.columns, settings.subdivision), subdivided(size.rows, settings.subdivision)};
}

std::vector<GridSize> gridSizesOf(const Scene& scene, const DiscretizationSettings& settings) {
  const DiscretizationSettings followed = followingScene(scene, settings);
  std::vector<GridSize> sizes;
  for (const Surface& surface : scene.surfaces) sizes.push_back(gridSizeOf(surface, followed));
  if (followed.powersOfTwo) widenStrips(scene, followed, sizes);
  return sizes;
}

std::uint64_t totalTexels(std::span<const GridSize> sizes) {
  std::uint64_t texels = 0;
  for (const GridSize& size : sizes)
    texels += static_cast<std::uint64_t>(size.columns) * static_cast<std::uint64_t>(size.rows);
  return texels;
}

void requireAffordable(const Scene& scene, std::span<const GridSize> sizes) {
  constexpr std::uint64_t maxElements = 1 << 24;
  const std::uint64_t texels = totalTexels(sizes);
  const std::string file = scene.files.empty() ? std::string() : scene.files.front().string();
  if (texels >= 0xffffffff)
    throw raster::InputError(
        file, 0, "the surfaces have " + std::to_string(texels) + " texels in all, more than there are item IDs",
        "use fewer texels a surface");
  const std::string advice = "use larger texels", elements = std::to_string(texels) + " elements";
  if (texels > maxElements)
    raster::refuseSize(file,
                       "the scene becomes " + elements + ", more than " + std::to_string(maxElements) +
                           "; they take about " + raster::memoryText(texels * bytesPerElement) + " of memory, and long",
                       advice);
  raster::requireMemory(texels * bytesPerElement, file, "the scene with " + elements, advice);
}

DiscretizationSettings settingsForPages(const Scene& scene, int pages, int side, DiscretizationSettings settings) {
  settings.maxTexels = side;
  const auto fits = [&](double texelSize) {
    settings.texelSize = texelSize;
    return fit(scene, settings, pages, side);
  };
  double enough = 0;
  for (const Surface& surface : scene.surfaces) {
    const glm::dvec2 lengths = chartLengths(surface);
    enough = std::max({enough, lengths.x, lengths.y});
  }
  if (!fits(enough))
    throw raster::InputError(std::to_string(scene.surfaces.size()) + " surfaces do not fit " + std::to_string(pages) +
                                 " pages of " + std::to_string(side) + " x " + std::to_string(side) + " texels",
                             "use more or larger pages");
  // If all surfaces fit with their largest grids, no texel size is too small.
  double tooSmall = 0;
  while (enough > tooSmall * 1.001 && enough > 1e-9 * scene.extent) {
    const double middle = tooSmall == 0 ? enough / 2 : (tooSmall + enough) / 2;
    (fits(middle) ? enough : tooSmall) = middle;
  }
  settings.texelSize = enough;
  return settings;
}

}  // namespace hemitex::radiosity
