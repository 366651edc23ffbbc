#include "radiosity/textures/corner_radiosity.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "raster/base/cross.h"

namespace hemitex::radiosity {
namespace {

/// A triangle of a surface that is not discretized.
struct Facet {
  std::size_t surface = 0, triangle = 0;  ///< in Scene::surfaces, in Surface::triangles
  const Triangle* geometry = nullptr;
  glm::dvec3 normal{0.0};
  double area = 0;
  int material = 0;
  glm::dvec3 radiosity{0.0};
};

/// One of the three corners of a facet.
struct Corner {
  glm::dvec3 position{0.0};
  std::size_t facet = 0;
  std::size_t index = 0;
};

std::vector<Facet> collectFacets(const Scene& scene, const Discretization& discretization,
                                 const std::vector<glm::dvec3>& radiosity) {
  std::vector<Facet> facets;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const Surface& surface = scene.surfaces[s];
    const Grid& grid = discretization.grids[s];
    for (std::size_t t = 0; t < surface.triangles.size() && !isDiscretized(grid); ++t)
      facets.push_back({s, t, &surface.triangles[t], normal(surface.triangles[t]), area(surface.triangles[t]),
                        surface.material, radiosity[grid.elementOfTexel.front()]});
  }
  return facets;
}

std::vector<Corner> sortedCorners(const std::vector<Facet>& facets) {
  std::vector<Corner> corners;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) corners.push_back({facets[f].geometry->position[k], f, k});
  const auto key = [](const Corner& c) {
    return std::tuple(c.position.x, c.position.y, c.position.z, c.facet, c.index);
  };
  std::sort(corners.begin(), corners.end(), [&](const Corner& a, const Corner& b) { return key(a) < key(b); });
  return corners;
}

/// Whether light is smooth across both: the same material, and normals less than 30 degrees apart.
bool areSmooth(const Facet& a, const Facet& b) {
  return a.material == b.material && glm::dot(a.normal, b.normal) > std::sqrt(3.0) / 2;
}

/// A triangle of a chart, in texels of the display texture. The place has its lower left corner at the origin.
using FlatTriangle = std::array<glm::dvec2, 3>;

using raster::cross;

double squaredDistance(const glm::dvec2& point, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a, offset = point - a;
  const double place = std::clamp(glm::dot(offset, along) / glm::dot(along, along), 0.0, 1.0);
  const glm::dvec2 apart = offset - place * along;
  return glm::dot(apart, apart);
}

/// The barycentric coordinates of a point; a triangle of a chart has area.
glm::dvec3 weightsIn(const FlatTriangle& t, const glm::dvec2& point) {
  const double area = cross(t[1] - t[0], t[2] - t[0]);
  const double second = cross(point - t[0], t[2] - t[0]) / area, third = cross(t[1] - t[0], point - t[0]) / area;
  return {1 - second - third, second, third};
}

}  // namespace

std::vector<std::vector<CornerColours>> cornerRadiosity(const Scene& scene, const Discretization& discretization,
                                                        const std::vector<glm::dvec3>& radiosity) {
  const std::vector<Facet> facets = collectFacets(scene, discretization, radiosity);
  const std::vector<Corner> corners = sortedCorners(facets);
  std::vector<std::vector<CornerColours>> result(scene.surfaces.size());
  for (const Facet& facet : facets) result[facet.surface].resize(facet.triangle + 1);
  for (auto first = corners.begin(); first != corners.end();) {
    const auto last =
        std::find_if(first, corners.end(), [&](const Corner& c) { return c.position != first->position; });
    for (auto corner = first; corner != last; ++corner) {
      const Facet& facet = facets[corner->facet];
      glm::dvec3 flux(0.0);
      double totalArea = 0;
      for (auto other = first; other != last; ++other) {
        const Facet& neighbour = facets[other->facet];
        if (!areSmooth(facet, neighbour)) continue;
        flux += neighbour.area * neighbour.radiosity;
        totalArea += neighbour.area;
      }
      result[facet.surface][facet.triangle][corner->index] = flux / totalArea;
    }
    first = last;
  }
  return result;
}

void drawCorners(const Surface& surface, const std::vector<CornerColours>& corners, const TexturePlace& place,
                 const Grid& grid, int magnification, Image& texture) {
  constexpr double reach = 1.5;
  const glm::ivec2 size = magnification * glm::ivec2(grid.columns, grid.rows);
  const glm::ivec2 border(magnification), sides = size + 2 * border;
  std::vector<double> nearest(static_cast<std::size_t>(sides.x) * static_cast<std::size_t>(sides.y), reach * reach);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    FlatTriangle flat;
    for (std::size_t k = 0; k < 3; ++k) flat[k] = surface.triangles[t].chart[k] * glm::dvec2(size);
    const glm::dvec2 low = glm::min(flat[0], glm::min(flat[1], flat[2])) - reach,
                     high = glm::max(flat[0], glm::max(flat[1], flat[2])) + reach;
    const glm::ivec2 first = glm::max(glm::ivec2(glm::floor(low)), -border),
                     end = glm::min(glm::ivec2(glm::ceil(high)), size + border);
    for (int row = first.y; row < end.y; ++row)
      for (int column = first.x; column < end.x; ++column) {
        const glm::dvec2 centre(column + 0.5, row + 0.5);
        const glm::dvec3 weights = weightsIn(flat, centre);
        const bool isInside = std::min({weights.x, weights.y, weights.z}) >= 0;
        const double distance =
            isInside ? 0
                     : std::min({squaredDistance(centre, flat[0], flat[1]), squaredDistance(centre, flat[1], flat[2]),
                                 squaredDistance(centre, flat[2], flat[0])});
        double& known = nearest[static_cast<std::size_t>((row + border.y) * sides.x + column + border.x)];
        if (distance >= known) continue;
        known = distance;
        const int x = place.column * magnification + column;
        const int y = texture.height - 1 - (place.row * magnification + row);
        texture.pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(texture.width) +
                       static_cast<std::size_t>(x)] =
            weights.x * corners[t][0] + weights.y * corners[t][1] + weights.z * corners[t][2];
      }
  }
}

}  // namespace hemitex::radiosity
