#include "cli/solve/run.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/pictures/visibility.h"
#include "reference/matrices/matrix_rows.h"

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
  if (boundsRows(options))
    settings.solver.residual = radiosity::residualFor(*options.maxError);
  else
    settings.maxError = options.maxError;
  if (followsCamera(options)) settings.seen = seenIn(options.camera, scene, camera);
  return settings;
}

/// The rows of the method of the options; empty if they are drawn.
radiosity::OtherRows rowsOf(const SolveOptions& options, const reference::RowErrors& errors) {
  if (!options.matrix.empty()) return reference::matrixRows(options.matrix);
  if (boundsRows(options)) return reference::boundedRows(*options.maxError, errors);
  if (usesRays(options)) return reference::rayRows({options.samples, reference::RayStart::Area, options.seed});
  return {};
}

}  // namespace

radiosity::LightHooks hooksOf(const SolveOptions& options, const reference::RowErrors& errors) {
  return {.layOut = [ids = options.id](
                        const radiosity::Discretization& discretization) { return layoutOf(ids, discretization); },
          .makeRenderer = options.makeRenderer,
          .rows = rowsOf(options, errors)};
}

SolveResult solveScene(const SolveOptions& asked, const radiosity::Scene& scene, const radiosity::Camera& camera,
                       radiosity::Discretization discretization, Monitor& monitor) {
  SolveResult result{asked};
  const auto errors = std::make_shared<std::vector<double>>();
  radiosity::LightHooks hooks = hooksOf(asked, errors);
  hooks.start = [&](const radiosity::SolverSettings& settings) {
    result.convergence = {};
    std::optional<radiosity::Snapshot> snapshot = monitor.begin();
    return radiosity::SolutionStart{std::move(snapshot), monitor.progressOf(settings, result.convergence)};
  };
  hooks.ranks = asked.ranks;
  result.light = radiosity::light(scene, std::move(discretization), lightSettings(asked, scene, camera), hooks);
  monitor.console().endProgress();
  result.options.drawing = result.light.settings.drawing;
  result.options.solver = result.light.settings.solver;
  result.rowErrors = *errors;
  if (const std::optional<radiosity::RowCounts>& counts = result.light.rowsAhead)
    monitor.console().detail(std::to_string(counts->ahead) + " rows were computed ahead, of which " +
                             std::to_string(counts->used) + " were used; rank 0 computed " +
                             std::to_string(counts->ofRankZero) + " when they were needed");
  return result;
}

}  // namespace hemitex::cli
