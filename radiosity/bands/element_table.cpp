#include "radiosity/bands/element_table.h"

#include <string>
#include <utility>
#include <vector>

#include "radiosity/bands/band_textures.h"
#include "radiosity/discretization/patch_points.h"

namespace hemitex::radiosity {

Table elementTable(const Scene& scene, const Discretization& discretization, const Solution& solution,
                   const BandSolution* bands) {
  const std::vector<double> wavelengths = bands ? bands->wavelengths : std::vector<double>();
  std::vector<std::string> columns{"surface", "column", "row",  "x",   "y",   "z",  "nx",
                                   "ny",      "nz",     "area", "b_r", "b_g", "b_b"};
  for (const double wavelength : wavelengths) columns.push_back(bandName(wavelength));
  const auto row = [&scene, &discretization, &solution, bands, placeOf = elementPlaces(scene, discretization),
                    count = wavelengths.size()](std::size_t index) {
    const Element& element = discretization.elements[index];
    const auto texels = static_cast<std::uint32_t>(discretization.grids[element.surface].columns);
    const SurfacePoint place = placeOf(static_cast<std::uint32_t>(index));
    std::vector<Cell> cells{scene.surfaces[element.surface].name, std::int64_t{element.texel % texels},
                            std::int64_t{element.texel / texels}};
    for (const glm::dvec3& vector : {place.position, place.normal})
      cells.insert(cells.end(), {vector.x, vector.y, vector.z});
    const glm::dvec3& b = solution.radiosity[index];
    cells.insert(cells.end(), {element.area, b.r, b.g, b.b});
    for (std::size_t band = 0; band < count; ++band) cells.emplace_back(radiosityIn(*bands, band, index));
    return cells;
  };
  return {std::move(columns), discretization.elements.size(), row};
}

}  // namespace hemitex::radiosity
