#include "radiosity/bands/element_table.h"

#include <string>
#include <utility>
#include <vector>

#include "radiosity/bands/band_textures.h"
#include "radiosity/discretization/patch_points.h"

namespace hemitex::radiosity {

Table elementTable(const Scene& scene, const Discretization& discretization, const Solution& solution) {
  std::vector<std::string> columns{"surface", "column", "row",  "x",   "y",   "z",  "nx",
                                   "ny",      "nz",     "area", "b_r", "b_g", "b_b"};
  const std::vector<double>& wavelengths = scene.wavelengths;
  for (std::size_t band = wavelengths.size(); band-- > 0;) columns.push_back(bandName(wavelengths[band]));
  const auto row = [&scene, &discretization, &solution,
                    placeOf = elementPlaces(scene, discretization)](std::size_t index) {
    const Element& element = discretization.elements[index];
    const auto texels = static_cast<std::uint32_t>(discretization.grids[element.surface].columns);
    const SurfacePoint place = placeOf(static_cast<std::uint32_t>(index));
    std::vector<Cell> cells{scene.surfaces[element.surface].name, std::int64_t{element.texel % texels},
                            std::int64_t{element.texel / texels}};
    for (const glm::dvec3& vector : {place.position, place.normal})
      cells.insert(cells.end(), {vector.x, vector.y, vector.z});
    const glm::dvec3& b = solution.radiosity[index];
    cells.insert(cells.end(), {element.area, b.r, b.g, b.b});
    for (std::size_t band = scene.wavelengths.size(); band-- > 0;)
      cells.emplace_back(solution.radiosityInBands[index][band]);
    return cells;
  };
  return {std::move(columns), discretization.elements.size(), row};
}

}  // namespace hemitex::radiosity
