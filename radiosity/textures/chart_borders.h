/// Makes display textures agree across the charts of a curved part.
///
/// A filter knows the elements of one chart only, so that both charts of a common edge of the mesh show different
/// values there. The mean over the charts at each common vertex is the value that all of them shall show. Each chart is
/// corrected by the difference, interpolated along the common edges, which fades out over two texels of the grid.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "radiosity/textures/texture_filter.h"

namespace hemitex::radiosity {

/// An edge of the mesh between two charts of a curved part.
struct BorderEdge {
  std::array<glm::dvec2, 2> ends{};        ///< in texels of the grid, from the corner of the chart
  std::array<glm::dvec3, 2> correction{};  ///< to add to the filtered values at the ends, in W/m^2
};

/// The border edges of each surface, for one value per element and a filter with a kernel. Other filters and surfaces
/// of one element have none.
std::vector<std::vector<BorderEdge>> borderEdges(const Scene& scene, const Discretization& discretization,
                                                 const std::vector<glm::dvec3>& radiosity, TextureFilter filter);

/// Corrects the values of a surface's texture near its border edges; see filteredTexels. Values stay at least 0.
void correctBorders(const Grid& grid, const std::vector<glm::dvec3>& radiosity, TextureFilter filter, int magnification,
                    const std::vector<BorderEdge>& edges, std::vector<glm::dvec3>& texels);

}  // namespace hemitex::radiosity
