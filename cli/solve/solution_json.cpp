#include "cli/solve/solution_json.h"

#include "cli/common/json.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/index_maps/phantom_indices.h"

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

/// The area of a surface's elements, and means over this area.
struct SurfaceMeans {
  double area = 0;
  glm::dvec3 radiosity{0.0}, reflectance{0.0}, emission{0.0};
};

SurfaceMeans meansOf(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                     const radiosity::Solution& solution, std::uint32_t surface) {
  const radiosity::Grid& grid = discretization.grids[surface];
  const radiosity::SurfaceValues reflectance = reflectances(scene, discretization, surface),
                                 emission = emissions(scene, discretization, surface);
  SurfaceMeans means;
  for (const std::uint32_t e : radiosity::elementsOf(grid)) {
    const double area = discretization.elements[e].area;
    means.area += area;
    means.radiosity += solution.radiosity[e] * area;
    means.reflectance += reflectance.of(e) * area;
    means.emission += emission.of(e) * area;
  }
  if (means.area > 0)
    for (glm::dvec3* mean : {&means.radiosity, &means.reflectance, &means.emission}) *mean /= means.area;
  return means;
}

/// Number of texels completely inside solids.
std::uint64_t buriedTexels(const radiosity::Discretization& discretization) {
  std::uint64_t buried = 0;
  for (const radiosity::Grid& grid : discretization.grids) buried += grid.buried;
  return buried;
}

/// The texture of a surface and its place there.
ordered_json placeJson(const radiosity::TextureLayout& textures, std::uint32_t surface) {
  const radiosity::TexturePlace& place = textures.places[surface];
  const auto texture = static_cast<std::size_t>(place.texture);
  const radiosity::TextureLayout::Size& size = textures.textures[texture];
  return {{"name", textures.names[texture]}, {"width", size.width}, {"height", size.height},
          {"column", place.column},          {"row", place.row},    {"magnification", size.magnification}};
}

ordered_json surfacesJson(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                          const std::optional<radiosity::TextureLayout>& textures,
                          const radiosity::Solution& solution) {
  const auto patches = radiosity::patchesOfSurfaces(discretization.patches, discretization.grids.size());
  ordered_json surfaces = ordered_json::array();
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const SurfaceMeans means = meansOf(scene, discretization, solution, s);
    const radiosity::Grid& grid = discretization.grids[s];
    surfaces.push_back({{"name", scene.surfaces[s].name},
                        {"columns", grid.columns},
                        {"rows", grid.rows},
                        {"elements", grid.elementCount},
                        {"patches", patches[s].size()},
                        {"area", means.area},
                        {"radiosity", toJson(means.radiosity)},
                        {"reflectance", toJson(means.reflectance)},
                        {"emission", toJson(means.emission)},
                        {"texture", textures ? placeJson(*textures, s) : ordered_json()}});
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
                      const radiosity::IdLayout& layout, const std::optional<radiosity::TextureLayout>& textures,
                      const radiosity::Solution& solution) {
  const radiosity::Phantoms phantoms = radiosity::countPhantoms(discretization, layout);
  return {{"surfaces", surfacesJson(scene, discretization, textures, solution)},
          {"elements", discretization.elements.size()},
          {"patches", discretization.patches.list.size()},
          {"phantoms", phantoms.spareTexels + phantoms.alignmentGaps},
          {"buried", buriedTexels(discretization)},
          {"phantom_causes", {{"spare_texels", phantoms.spareTexels}, {"alignment_gaps", phantoms.alignmentGaps}}},
          {"index_bits", layout.indexBits},
          {"shots", solution.shots},
          {"residual", solution.residual},
          {"energy", energyJson(solution.energy, radiosity::brightest(scene.outside) > 0)}};
}

}  // namespace hemitex::cli
