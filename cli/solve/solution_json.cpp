#include "cli/solve/solution_json.h"

#include "cli/common/json.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/index_maps/phantom_indices.h"
#include "radiosity/textures/radiosity_texture.h"

namespace hemitex::cli {

using nlohmann::ordered_json;

Table elementTable(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const radiosity::Solution& solution) {
  const auto row = [&](std::size_t index) -> std::vector<Cell> {
    const radiosity::Element& element = discretization.elements[index];
    const auto columns = static_cast<std::uint32_t>(discretization.grids[element.surface].columns);
    const auto [centre, normal, triangle] =
        radiosity::elementCentre(scene, discretization, static_cast<std::uint32_t>(index));
    const glm::dvec3& b = solution.radiosity[index];
    return {scene.surfaces[element.surface].name,
            std::int64_t{element.texel % columns},
            std::int64_t{element.texel / columns},
            centre.x,
            centre.y,
            centre.z,
            normal.x,
            normal.y,
            normal.z,
            element.area,
            b.r,
            b.g,
            b.b};
  };
  return {{"surface", "column", "row", "x", "y", "z", "nx", "ny", "nz", "area", "b_r", "b_g", "b_b"},
          discretization.elements.size(),
          row};
}

namespace {

double areaOf(const radiosity::Discretization& discretization, const radiosity::Grid& grid) {
  double area = 0;
  for (std::uint32_t e = 0; e < grid.elementCount; ++e) area += discretization.elements[grid.firstElement + e].area;
  return area;
}

/// Number of texels completely inside solids.
std::uint64_t buriedTexels(const radiosity::Discretization& discretization) {
  std::uint64_t buried = 0;
  for (const radiosity::Grid& grid : discretization.grids) buried += grid.buried;
  return buried;
}

ordered_json surfacesJson(const radiosity::Scene& scene, const radiosity::Discretization& discretization) {
  const radiosity::TextureLayout textures = radiosity::layOutTextures(scene, discretization);
  ordered_json surfaces = ordered_json::array();
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const radiosity::Grid& grid = discretization.grids[s];
    const radiosity::TexturePlace& place = textures.places[s];
    const auto texture = static_cast<std::size_t>(place.texture);
    surfaces.push_back({{"name", scene.surfaces[s].name},
                        {"columns", grid.columns},
                        {"rows", grid.rows},
                        {"elements", grid.elementCount},
                        {"patches", radiosity::patchesOf(grid).size()},
                        {"area", areaOf(discretization, grid)},
                        {"texture",
                         {{"name", textures.names[texture]},
                          {"width", textures.textures[texture].width},
                          {"height", textures.textures[texture].height},
                          {"column", place.column},
                          {"row", place.row}}}});
  }
  return surfaces;
}

ordered_json energyJson(const radiosity::Energy& energy, bool isLitFromOutside) {
  ordered_json text = {{"emitted", toJson(energy.emitted)},
                       {"absorbed", toJson(energy.absorbed)},
                       {"unshot", toJson(energy.unshot)},
                       {"lost", toJson(energy.lost)},
                       {"lost_to_backs", toJson(energy.lostToBacks)}};
  if (isLitFromOutside) text["sky_on_backs"] = toJson(energy.skyOnBacks);
  return text;
}

}  // namespace

ordered_json describe(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                      const radiosity::IdLayout& layout, const radiosity::Solution& solution) {
  const radiosity::Phantoms phantoms = radiosity::countPhantoms(discretization, layout);
  return {{"surfaces", surfacesJson(scene, discretization)},
          {"elements", discretization.elements.size()},
          {"patches", discretization.patches.size()},
          {"phantoms", phantoms.spareTexels + phantoms.alignmentGaps},
          {"buried", buriedTexels(discretization)},
          {"phantom_causes", {{"spare_texels", phantoms.spareTexels}, {"alignment_gaps", phantoms.alignmentGaps}}},
          {"index_bits", layout.indexBits},
          {"shots", solution.shots},
          {"residual", solution.residual},
          {"energy", energyJson(solution.energy, radiosity::brightest(scene.outside) > 0)}};
}

}  // namespace hemitex::cli
