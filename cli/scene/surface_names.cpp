#include "cli/scene/surface_names.h"

#include <map>
#include <set>

#include "cli/common/numbers.h"
#include "raster/base/input_error.h"
#include "raster/base/name_suggestions.h"

namespace hemitex::cli {
namespace {

std::vector<std::uint32_t> find(const radiosity::Scene& scene, const std::string& name) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (!scene.surfaces[s].imageOf && (scene.surfaces[s].name == name || scene.surfaces[s].family == name))
      found.push_back(s);
  return found;
}

/// The most similar names of families, quoted.
std::string suggestions(const radiosity::Scene& scene, const std::string& wrong) {
  std::set<std::string> families;
  for (const radiosity::Surface& surface : scene.surfaces) families.insert(surface.family);
  return raster::nearestNames(families, wrong);
}

/// Reads `COL,ROW`; nothing for any other text.
std::optional<std::pair<int, int>> parseTexel(const std::string& text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string::npos) return std::nullopt;
  const std::optional<int> column = parseInteger(text.substr(0, comma));
  const std::optional<int> row = parseInteger(text.substr(comma + 1));
  if (!column || !row) return std::nullopt;
  return std::pair{*column, *row};
}

}  // namespace

std::vector<std::uint32_t> surfacesNamed(const radiosity::Scene& scene, const std::string& name) {
  std::vector<std::uint32_t> found = find(scene, name);
  if (found.empty())
    throw raster::InputError("no surface is named `" + raster::excerpt(name) + "`",
                             "similar names: " + suggestions(scene, name));
  return found;
}

Source sourceNamed(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                   const std::string& text) {
  const std::size_t colon = text.rfind(':');
  const auto texel = colon == std::string::npos ? std::nullopt : parseTexel(raster::excerpt(text.substr(colon + 1)));
  if (!texel || !find(scene, text).empty()) return {surfacesNamed(scene, text)};

  const std::string name = text.substr(0, colon);
  const std::vector<std::uint32_t> surfaces = surfacesNamed(scene, name);
  if (surfaces.size() > 1)
    throw raster::InputError(
        "`" + raster::excerpt(name) + "` has " + std::to_string(surfaces.size()) + " parts",
        "give the name of the part with the texel: `" + raster::excerpt(scene.surfaces[surfaces[0]].name) + "`, ...");
  const radiosity::Grid& grid = discretization.grids[surfaces[0]];
  const auto [column, row] = *texel;
  if (column < 0 || column >= grid.columns || row < 0 || row >= grid.rows)
    throw raster::InputError("`" + raster::excerpt(name) + "` has no texel " + raster::excerpt(text.substr(colon + 1)),
                             "its grid has " + std::to_string(grid.columns) + " columns and " +
                                 std::to_string(grid.rows) + " rows, numbered from 0");
  const auto index =
      static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column);
  if (!grid.covered[index])
    throw raster::InputError("texel " + raster::excerpt(text.substr(colon + 1)) + " of `" + raster::excerpt(name) +
                             "` lies outside the surface; choose another texel");
  return {surfaces, grid.elementOfTexel[index]};
}

Families familiesOf(const radiosity::Scene& scene) {
  Families families;
  std::map<std::string, std::uint32_t> numbers;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const std::string& name = scene.surfaces[s].family;
    const auto [known, added] = numbers.emplace(name, static_cast<std::uint32_t>(families.names.size()));
    if (added) {
      families.names.push_back(name);
      families.surfaces.emplace_back();
    }
    if (!scene.surfaces[s].imageOf) families.surfaces[known->second].push_back(s);
    families.ofSurface.push_back(known->second);
  }
  return families;
}

Families facetsOf(const radiosity::Scene& scene) {
  Families facets{{}, std::vector<std::vector<std::uint32_t>>(scene.faces), {}};
  for (std::size_t f = 0; f < scene.faces; ++f) facets.names.push_back(std::to_string(f));
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const std::uint32_t facet = scene.surfaces[s].triangles.front().polygon;
    facets.names[facet] = scene.surfaces[s].family;
    if (!scene.surfaces[s].imageOf) facets.surfaces[facet].push_back(s);
    facets.ofSurface.push_back(facet);
  }
  return facets;
}

}  // namespace hemitex::cli
