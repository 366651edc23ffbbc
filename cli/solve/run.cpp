#include "cli/solve/run.h"

#include <algorithm>
#include <memory>
#include <string>
#include <utility>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/grid_size.h"
#include "radiosity/images/image_module.h"
#include "raster/base/memory_budget.h"

namespace hemitex::cli {
namespace {

radiosity::LightSettings lightSettings(const SolveOptions& options, const radiosity::Scene& scene,
                                       const radiosity::Camera& camera) {
  radiosity::LightSettings settings{.drawing = options.drawing,
                                    .solver = options.solver,
                                    .isResidualDefault = !options.residual && !options.maxError,
                                    .adaptive = options.adaptive,
                                    .elements = options.discretization,
                                    .isContinued = options.isContinued};
  if (boundsLight(options)) {
    settings.maxError = options.maxError;
    settings.coarsest = options.coarsest;
    settings.residual = options.residual;
  } else if (options.maxError) {
    const double bound = radiosity::residualFor(*options.maxError);
    settings.solver.residual = std::min(bound, options.residual.value_or(bound));
  }
  if (followsCamera(options)) settings.seen = surfacesSeen(options.camera, scene, camera);
  return settings;
}

/// The rows of the method of the options; empty if they are drawn.
radiosity::OtherRows rowsOf(const SolveOptions& options, const reference::RowErrors& errors) {
  if (!options.matrix.empty()) return reference::matrixRows(options.matrix);
  if (boundsRows(options)) return reference::boundedRows(*options.maxError, errors);
  if (usesRays(options)) return reference::rayRows({options.samples, reference::RayStart::Area, options.seed});
  return {};
}

constexpr std::uint64_t ofProgram = 300'000'000, perSurface = 4300;

/// The rows that the cache may hold: about a patch has 16 elements and a row has 16 bytes per element.
std::uint64_t rowBytes(std::uint64_t elements, std::uint64_t budget) {
  return elements < 1 << 24 ? std::min(budget, elements * elements) : budget;
}

}  // namespace

void requireMemoryOfRun(const radiosity::Scene& scene, const SolveOptions& options) {
  const std::uint64_t elements = radiosity::totalTexels(radiosity::gridSizesOf(scene, options.discretization));
  raster::requireMemory(ofProgram + elements * radiosity::bytesPerElement + scene.surfaces.size() * perSurface +
                            radiosity::triangleCount(scene) * radiosity::bytesPerTriangle +
                            rowBytes(elements, options.solver.rowCacheBytes),
                        options.scene.file.string(), "the run with " + std::to_string(elements) + " elements",
                        "use larger texels or a smaller --row-cache");
}

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
