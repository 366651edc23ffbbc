#include "radiosity/scene/surface_names.h"

#include <algorithm>
#include <map>
#include <set>

#include "radiosity/base/name_suggestions.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

std::vector<std::uint32_t> find(const Scene& scene, const std::string& name) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    if (scene.surfaces[s].name == name || scene.surfaces[s].family == name) found.push_back(s);
  return found;
}

/// The most similar names of families, quoted.
std::string suggestions(const Scene& scene, const std::string& wrong) {
  std::set<std::string> families;
  for (const Surface& surface : scene.surfaces) families.insert(surface.family);
  return nearestNames(families, wrong);
}

}  // namespace

bool isSurfaceName(const Scene& scene, const std::string& name) { return !find(scene, name).empty(); }

std::vector<std::uint32_t> surfacesNamed(const Scene& scene, const std::string& name) {
  std::vector<std::uint32_t> found = find(scene, name);
  if (!found.empty()) return found;
  refuseHidden(scene, name);
  throw raster::InputError("no surface is named `" + raster::excerpt(name) + "`",
                           "similar names: " + suggestions(scene, name));
}

void refuseHidden(const Scene& scene, const std::string& name) {
  if (std::any_of(scene.objects.begin(), scene.objects.end(),
                  [&](const SceneObject& object) { return object.name == name; }))
    throw raster::InputError("nothing of `" + raster::excerpt(name) + "` can be seen, because other faces cover it",
                             "omit it, or move it in front of them");
}

Families familiesOf(const Scene& scene) {
  Families families;
  std::map<std::string, std::uint32_t> numbers;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const std::string& name = scene.surfaces[s].family;
    const auto [known, added] = numbers.emplace(name, static_cast<std::uint32_t>(families.names.size()));
    if (added) {
      families.names.push_back(name);
      families.surfaces.emplace_back();
    }
    families.surfaces[known->second].push_back(s);
    families.ofSurface.push_back(known->second);
  }
  return families;
}

Families facetsOf(const Scene& scene) {
  Families facets{{}, std::vector<std::vector<std::uint32_t>>(scene.faces), {}};
  for (std::size_t f = 0; f < scene.faces; ++f) facets.names.push_back(std::to_string(f));
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const std::uint32_t facet = scene.surfaces[s].triangles.front().polygon;
    facets.names[facet] = scene.surfaces[s].family;
    facets.surfaces[facet].push_back(s);
    facets.ofSurface.push_back(facet);
  }
  return facets;
}

}  // namespace hemitex::radiosity
