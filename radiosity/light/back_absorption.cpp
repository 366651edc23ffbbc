#include "radiosity/light/back_absorption.h"

#include <algorithm>
#include <memory>

#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {
namespace {

/// All fronts have item ID 0; the back of surface s has s + 1.
raster::DrawList drawsOfBacks(const Scene& scene) {
  raster::DrawList list;
  list.format = *raster::formatNamed("r32ui");
  HoleMaps holes(scene);
  for (const Instance& instance : scene.instances)
    for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
      const Surface& surface = scene.surfaces[s];
      appendDraw(list, surface.triangles, instance, scene.origin).back = static_cast<raster::ItemId>(s + 1);
      holes.cut(list, list.draws.size() - 1, surface, surface.triangles, instance);
    }
  return list;
}

/// The patches with the largest absorbed flux, bands summed; of equal ones the first.
std::vector<std::uint32_t> largestFirst(const std::vector<glm::dvec3>& absorbed, std::size_t count) {
  const auto size = [&](std::uint32_t patch) { return bandSum(glm::abs(absorbed[patch])); };
  std::vector<std::uint32_t> patches;
  for (std::uint32_t p = 0; p < absorbed.size(); ++p)
    if (size(p) > 0) patches.push_back(p);
  std::stable_sort(patches.begin(), patches.end(), [&](std::uint32_t a, std::uint32_t b) { return size(a) > size(b); });
  patches.resize(std::min(patches.size(), count));
  return patches;
}

/// Adds the shares of the backs that a view sees, times its area.
void addBacks(const View& view, const std::vector<raster::ItemBuffer>& buffers, std::vector<double>& shares) {
  for (std::size_t face = 0; face < buffers.size(); ++face) {
    const std::vector<std::uint64_t>& before = view.projection->sharesBefore[view.projection->faces[face].shares];
    const std::vector<raster::ItemId>& ids = buffers[face].ids;
    for (std::size_t i = 0; i < ids.size(); ++i)
      if (ids[i] - 1 < shares.size()) shares[ids[i] - 1] += view.area * formFactor(before[i + 1] - before[i]);
  }
}

}  // namespace

BackAbsorption backAbsorption(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                              const DrawingSettings& settings, const std::vector<glm::dvec3>& absorbedByBacks,
                              std::size_t maxPatches) {
  BackAbsorption result{.ofSurfaces = std::vector<glm::dvec3>(scene.surfaces.size())};
  const std::vector<std::uint32_t> patches = largestFirst(absorbedByBacks, maxPatches);
  if (patches.empty()) return result;
  const std::unique_ptr<raster::ItemBufferRenderer> renderer = softwareRenderer(drawsOfBacks(scene));
  ProjectedFormFactors views(scene, discretization, layout, *renderer,
                             {settings.resolution, settings.orientation, settings.projection});
  for (const std::uint32_t patch : patches) {
    std::vector<double> shares(scene.surfaces.size());
    for (const View& view : views.viewsOfPatch(discretization.patches.list[patch]))
      addBacks(view, render(*renderer, view.faces, view.skipped), shares);
    double all = 0;
    for (const double share : shares) all += share;
    if (all == 0) continue;
    for (std::size_t s = 0; s < shares.size(); ++s) result.ofSurfaces[s] += absorbedByBacks[patch] * (shares[s] / all);
    ++result.patches;
  }
  return result;
}

}  // namespace hemitex::radiosity
