#include "cli/solve/run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "cli/solve/facet_rows.h"
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

SolveResult solveScene(const SolveOptions& asked, const radiosity::Scene& scene, const radiosity::Camera& camera,
                       radiosity::Discretization discretization, Monitor& monitor) {
  SolveResult result{asked};
  std::optional<BoundedRows> bounded;
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
      .ranks = asked.ranks};
  result.light = radiosity::light(scene, std::move(discretization), lightSettings(asked, scene, camera), hooks);
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
