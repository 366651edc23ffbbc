#include "cli/solve/run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "cli/solve/facet_rows.h"
#include "radiosity/bands/shared_rows.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/pictures/visibility.h"
#include "reference/truth/rays/embree_form_factors.h"

namespace hemitex::cli {
namespace {

/// The surfaces that are seen in a picture of the proportions of render.png, with 256 pixels along its longer side.
std::vector<bool> seenIn(const CameraOptions& picture, const radiosity::Scene& scene, const radiosity::Camera& camera) {
  const auto scaled = [longer = std::max(picture.width, picture.height)](int side) {
    return std::max(1, 256 * side / longer);
  };
  return radiosity::seenSurfaces(scene, camera, scaled(picture.width), scaled(picture.height));
}

/// The solutions of all groups, and the patches of the last one. Changes the light of the scene and the values of the
/// discretization, which the input refers to. The whole spectrum decides how the brightest patches are split.
radiosity::BandSolution solvedGroups(const BandScenes& scenes, radiosity::Scene& scene,
                                     radiosity::Discretization& discretization, radiosity::SolveInput input,
                                     const radiosity::Progress& progress) {
  std::vector<const BandLight*> lights;
  if (scenes.whole) lights.push_back(&*scenes.whole);
  for (const BandLight& group : scenes.groups) lights.push_back(&group);
  radiosity::Patches patches = std::move(input.patches);
  const auto inputOf = [&](std::size_t number) {
    setLight(scene, *lights[number]);
    radiosity::averageMaps(scene, discretization);
    radiosity::SolveInput next = input;
    for (glm::dvec3& flux : next.outside.received) flux = lights[number]->ofColour * flux;
    next.outside.onBacks = lights[number]->ofColour * next.outside.onBacks;
    return next;
  };
  radiosity::BandSolution solution{scenes.wavelengths,
                                   radiosity::solveWithSameRows(lights.size(), std::move(patches), inputOf, progress)};
  if (scenes.whole) solution.groups.erase(solution.groups.begin());
  return solution;
}

/// Solves in bands, and returns the solution in colour. Keeps references to the arguments; changes the light of
/// `scene`.
decltype(radiosity::LightHooks::solve) inBands(const BandScenes& scenes, radiosity::Scene& scene,
                                               std::optional<radiosity::BandSolution>& bands) {
  return [&](radiosity::SolveInput input, radiosity::Discretization& elements, const radiosity::Progress& progress) {
    const bool keepsIrradiance = input.settings.keepsIrradiance;
    bands = solvedGroups(scenes, scene, elements, std::move(input), progress);
    setLight(scene, {scenes.inColour.materials, scenes.inColour.images});
    radiosity::averageMaps(scene, elements);
    radiosity::Solution inColour = radiosity::inColour(scene, elements, *bands, keepsIrradiance);
    inColour.patches = std::move(bands->groups.back().patches);
    return inColour;
  };
}

radiosity::LightSettings lightSettings(const SolveOptions& options, const radiosity::Scene& scene,
                                       const radiosity::Camera& camera) {
  radiosity::LightSettings settings{.drawing = options.drawing,
                                    .solver = options.solver,
                                    .adaptive = options.adaptive,
                                    .elements = options.discretization,
                                    .isContinued = options.isContinued};
  if (boundsRows(options)) {
    settings.solver.residual = radiosity::residualFor(*options.maxError);
  } else if (options.maxError) {
    settings.maxError = options.maxError;
    settings.seen = seenIn(options.camera, scene, camera);
  }
  return settings;
}

/// The rows of the method of the options. `bounded` keeps rows with bounded errors.
radiosity::PatchRows rowsOf(const SolveOptions& options, radiosity::PatchRows drawn, const radiosity::Scene& scene,
                            const radiosity::Discretization& discretization, std::optional<BoundedRows>& bounded) {
  if (!options.matrix.empty()) return {matrixRows(options.matrix, scene, discretization)};
  if (boundsRows(options)) {
    bounded.emplace(scene, discretization, *options.maxError);
    return {.rowOf = [&bounded](const radiosity::Patch& patch) { return bounded->row(patch); },
            .prepare = [&bounded](const radiosity::Step& step) { bounded->lookAhead(step); }};
  }
  if (!usesRays(options)) return drawn;
  // Patches are split by hemicubes for rays, too.
  const auto rays = std::make_shared<reference::RayRows>(
      scene, discretization, reference::RayRowSettings{options.samples, reference::RayStart::Area, options.seed});
  return {.rowOf = [rays](const radiosity::Patch& patch) { return rays->ofPatch(patch); }, .split = drawn.split};
}

}  // namespace

radiosity::LayoutFactory layoutsOf(const radiosity::IdSettings& ids) {
  return [ids](const radiosity::Discretization& discretization) { return layoutOf(ids, discretization); };
}

SolveResult solveScene(const SolveOptions& asked, const radiosity::Scene& scene, const BandScenes* bands,
                       const radiosity::Camera& camera, radiosity::Discretization discretization, Monitor& monitor) {
  SolveResult result{asked};
  std::optional<BoundedRows> bounded;
  std::optional<radiosity::Scene> inGroup;  // has the light of one group of bands at a time
  if (bands) inGroup = scene;
  const radiosity::LightHooks hooks{
      .layOut = layoutsOf(asked.id),
      .start =
          [&](const radiosity::SolverSettings& settings) {
            result.convergence = {};
            std::optional<radiosity::Snapshot> snapshot = monitor.begin();
            return radiosity::SolutionStart{std::move(snapshot), monitor.progressOf(settings, result.convergence)};
          },
      .rows =
          [&](radiosity::PatchRows drawn, const radiosity::Scene& of, const radiosity::Discretization& elements) {
            return rowsOf(asked, std::move(drawn), of, elements, bounded);
          },
      .solve = bands ? inBands(*bands, *inGroup, result.bands) : nullptr,
      .ranks = asked.ranks};
  result.light = radiosity::light(inGroup ? *inGroup : scene, std::move(discretization),
                                  lightSettings(asked, scene, camera), hooks);
  monitor.console().endProgress();
  result.options.drawing = result.light.settings.drawing;
  result.options.solver = result.light.settings.solver;
  if (bounded) result.rowErrors = bounded->errors();
  if (const std::optional<radiosity::RowCounts>& counts = result.light.rowsAhead)
    monitor.console().detail(std::to_string(counts->ahead) + " rows were computed ahead, of which " +
                             std::to_string(counts->used) + " were used; rank 0 computed " +
                             std::to_string(counts->ofRankZero) + " when they were needed");
  return result;
}

}  // namespace hemitex::cli
