#include "radiosity/textures/corner_radiosity.h"

#include <algorithm>
#include <cmath>
#include <tuple>

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

}  // namespace hemitex::radiosity
