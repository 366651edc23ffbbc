#include "radiosity/form_factors/scene_form_factors.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "radiosity/discretization/element_materials.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/index_maps/meshed_draws.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "raster/software/software_renderer.h"

namespace hemitex::radiosity {
namespace {

/// The number of images of a lamp in its place: a lamp on a mirror plane is its own image, and lights each side with a
/// part of its flux.
double lampImages(const Scene& scene, const Lamp& lamp) {
  return static_cast<double>(
      std::count_if(scene.instances.begin(), scene.instances.end(), [&](const Instance& instance) {
        return instance(lamp.position) == lamp.position &&
               (!lamp.cone || instance.sign * lamp.cone->axis == lamp.cone->axis);
      }));
}

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> softwareRenderer(raster::DrawList list) {
  return std::make_unique<raster::SoftwareRenderer>(std::move(list));
}

std::unique_ptr<raster::ItemBufferRenderer> sceneRenderer(const Scene& scene, const Discretization& discretization,
                                                          const IdLayout& layout, ElementsBy elementsBy,
                                                          const RendererFactory& makeRenderer) {
  if (elementsBy == ElementsBy::Texture) return makeRenderer(makeDrawList(scene, discretization, layout));
  MeshedDraws mesh = makeMeshedDraws(scene, discretization, layout);
  return std::make_unique<MeshedRenderer>(makeRenderer(std::move(mesh.list)), std::move(mesh.firstPiece));
}

Patches splitAll(Patches patches, const PatchSplit& split) {
  const auto count = static_cast<std::uint32_t>(patches.list.size());
  for (std::uint32_t patch = 0; split && patch < count; ++patch)
    replacePatch(patches, patch, split(patches, patches.list[patch], 1));
  return patches;
}

SceneFormFactors::SceneFormFactors(const Scene& scene, const Discretization& discretization, IdLayout layout,
                                   const DrawingSettings& settings, const RendererFactory& makeRenderer)
    : scene_(scene),
      discretization_(discretization),
      layout_(std::move(layout)),
      directions_(std::max(8 * settings.resolution, minDirections)),
      renderer_(sceneRenderer(scene, discretization_, layout_, settings.elementsBy, makeRenderer)),
      rows_(scene, discretization_, layout_, *renderer_,
            {settings.resolution, settings.orientation, settings.projection, settings.pixelsPerElement}) {
  if (settings.split >= 1) return;
  if (settings.elementsBy == ElementsBy::Mesh)
    textures_ = softwareRenderer(makeDrawList(scene, discretization_, layout_));
  raster::ItemBufferRenderer& byTexture = textures_ ? *textures_ : *renderer_;
  splitter_.emplace(scene, discretization_, layout_, byTexture, settings.split);
  near_.emplace(scene, discretization_);
}

FormFactorRow SceneFormFactors::row(const Patch& patch) { return std::move(rows({&patch, 1}).front()); }

std::vector<FormFactorRow> SceneFormFactors::rows(std::span<const Patch> patches) {
  std::vector<std::vector<ViewPoint>> points;
  for (const Patch& patch : patches) points.push_back(rows_.pointsOfPatch(patch));
  std::vector<FormFactorRow> rows = rows_.ofManyPoints(points);
  for (std::size_t p = 0; p < patches.size(); ++p)
    if (auto better = corrected(patches[p], rows[p])) rows[p] = *std::move(better);
  return rows;
}

RowSource SceneFormFactors::rowOf() {
  return [this](const Patch& patch) { return row(patch); };
}

std::optional<FormFactorRow> SceneFormFactors::corrected(const Patch& patch, const FormFactorRow& drawn) {
  return near_ ? near_->corrected(patch, drawn) : std::nullopt;
}

OutsideFlux SceneFormFactors::fluxFromOutside() {
  const OutsideViews views = affordableViews(directions_, placedTriangleCount(scene_));
  if (scene_.instances.size() == 1) return radiosity::outsideFlux(scene_, discretization_, layout_, *renderer_, views);
  const IdLayout layout = layOut(discretization_, {.format = "r32ui", .blend = raster::Blend::IntegerAdd});
  const auto renderer = softwareRenderer(drawListWithBlockers(scene_, discretization_, layout));
  return radiosity::outsideFlux(scene_, discretization_, layout, *renderer, views);
}

/// Elements are chosen with probabilities as the flux that they reflect, by equal steps along its sum. One that sees
/// more of the scene than of what is outside is enclosed; its flux counts by the share that meets the scene.
double SceneFormFactors::countedShare(const OutsideFlux& flux) {
  constexpr int samples = 64;
  const double arrived = bandSum(sumOf(flux));
  if (!(arrived > 0)) return leastCounted;  // no front sees anything outside
  const ElementMaterials materials(scene_, discretization_);
  std::vector<double> reflected(flux.received.size());
  for (std::uint32_t e = 0; e < reflected.size(); ++e) {
    const std::span<const double> received = flux.received[e],
                                  reflectance = materials.reflectance(discretization_.elements[e].surface, e);
    reflected[e] = std::inner_product(received.begin(), received.end(), reflectance.begin(), 0.0);
  }
  const double all = std::accumulate(reflected.begin(), reflected.end(), 0.0);
  double before = 0, counted = 0;
  int sample = 0;
  for (std::uint32_t e = 0; e < reflected.size(); ++e) {
    before += reflected[e];
    const int first = sample;
    while (sample < samples && (sample + 0.5) * all < before * samples) ++sample;
    if (sample == first) continue;
    const std::uint32_t surface = discretization_.elements[e].surface;
    const FormFactorRow row = rows_.ofPoints(std::array{ViewPoint{
        .surface = surface, .point = elementCentre(scene_, discretization_, e), .up = {}, .halvings = maxHalvings}});
    const double meeting = 1 - formFactor(row.background + row.back);
    if (meeting > 0.5) counted += meeting * (sample - first);
  }
  return std::clamp(counted / samples * all / arrived, leastCounted, 1.0);
}

OutsideFlux SceneFormFactors::outsideFlux() {
  OutsideFlux flux = fluxFromOutside();
  if (!flux.received.empty()) flux.counted = countedShare(flux);
  for (std::uint32_t l = 0; l < scene_.lamps.size(); ++l) {
    const Lamp& lamp = scene_.lamps[l];
    if (lamp.intensity == glm::dvec3(0)) continue;
    const double scale = fullSolidAngle(lamp.cone) / scene_.squareMetres / lampImages(scene_, lamp);
    addLamp(flux, discretization_.elements.size(), rows_.ofLamp(lamp, l),
            scaled(lightInBands(scene_, lamp.intensity), scale));
  }
  return flux;
}

PatchSplit SceneFormFactors::splits() {
  if (!splitter_) return {};
  return [this](const Patches& patches, const Patch& patch, double weight) {
    return splitter_->split(patches, patch, weight);
  };
}

RowSource SceneFormFactors::scoutRows() {
  if (!splitter_) return {};
  return [this](const Patch& patch) { return splitter_->scoutRow(patch); };
}

std::vector<ViewPoint> SceneFormFactors::likelyPoints(const Patches& patches, Patch patch, double weight) {
  if (splitter_ && splitter_->wouldSplit(patches, patch, weight)) return {};
  if (splitter_ && !patch.isSettled) patch.halvings = halvingsFor(weight);
  return rows_.pointsOfPatch(patch);
}

}  // namespace hemitex::radiosity
