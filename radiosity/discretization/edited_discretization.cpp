#include "radiosity/discretization/edited_discretization.h"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/grid_size.h"

namespace hemitex::radiosity {
namespace {

/// The settings without entries for surfaces that the scene does not have.
DiscretizationSettings settingsFor(const Scene& scene, DiscretizationSettings settings) {
  std::erase_if(settings.surfaceTexels, [&](const auto& named) {
    return std::none_of(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
      return surface.name == named.first || surface.family == named.first;
    });
  });
  return settings;
}

/// Discretizes the new surfaces of a scene alone, without the solids that could bury them.
Discretization discretizeNew(const EditedScene& edit, const DiscretizationSettings& settings) {
  Scene scene;
  scene.materials = edit.scene.materials;
  scene.images = edit.scene.images;
  for (std::size_t s = 0; s < edit.origins.size(); ++s)
    if (!edit.origins[s].former) scene.surfaces.push_back(edit.scene.surfaces[s]);
  return scene.surfaces.empty() ? Discretization()
                                : discretizeUnburied(scene, settingsFor(scene, followingScene(edit.scene, settings)));
}

/// Appends a surface with its elements and these patches of it, renumbered.
void append(Discretization& whole, const Discretization& from, std::uint32_t number,
            const std::vector<std::uint32_t>& patches) {
  Grid grid = from.grids[number];
  const auto surface = static_cast<std::uint32_t>(whole.grids.size());
  // The difference may be negative; unsigned arithmetic wraps around to the right result.
  const std::uint32_t elementShift = static_cast<std::uint32_t>(whole.elements.size()) - grid.firstElement;
  for (const std::uint32_t e : elementsOf(grid)) {
    Element element = from.elements[e];
    element.surface = surface;
    whole.elements.push_back(element);
    whole.triangleOf.push_back(from.triangleOf[e]);
  }
  whole.patches.ofElement.resize(whole.elements.size());
  grid.firstPatch = static_cast<std::uint32_t>(whole.patches.list.size());
  grid.patchCount = static_cast<std::uint32_t>(patches.size());
  for (const std::uint32_t p : patches) {
    Patch patch = from.patches.list[p];
    patch.number = static_cast<std::uint32_t>(whole.patches.list.size());
    patch.surface = surface;
    for (std::uint32_t& element : patch.elements) {
      element += elementShift;
      whole.patches.ofElement[element] = patch.number;
    }
    whole.patches.list.push_back(std::move(patch));
  }
  for (std::uint32_t& element : grid.elementOfTexel) element += elementShift;
  grid.firstElement += elementShift;
  whole.grids.push_back(std::move(grid));
}

}  // namespace

Discretization carried(const Discretization& before, const EditedScene& edit, const DiscretizationSettings& settings) {
  const Discretization added = discretizeNew(edit, settings);
  const auto patchesBefore = patchesOfSurfaces(before.patches, before.grids.size());
  const auto patchesAdded = patchesOfSurfaces(added.patches, added.grids.size());
  std::uint32_t next = 0;
  Discretization whole;
  for (const Origin& origin : edit.origins) {
    const std::uint32_t number = origin.former ? *origin.former : next++;
    if (origin.former)
      append(whole, before, number, patchesBefore[number]);
    else
      append(whole, added, number, patchesAdded[number]);
  }
  averageMaps(edit.scene, whole);
  return whole;
}

}  // namespace hemitex::radiosity
