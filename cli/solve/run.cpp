#include "cli/solve/run.h"

#include <algorithm>
#include <functional>
#include <utility>

#include "cli/solve/facet_rows.h"
#include "radiosity/bands/shared_rows.h"
#include "radiosity/base/bytes.h"
#include "radiosity/discretization/adaptive_subdivision.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/pictures/visibility.h"
#include "radiosity/ranks/rows_ahead.h"
#include "radiosity/ranks/shared_tasks.h"
#include "radiosity/solver/dynamic_solution.h"
#include "reference/truth/rays/embree_form_factors.h"

namespace hemitex::cli {
namespace {

/// Ends a choice of settings between two of its solutions. Thrown and caught in this file.
struct Stopped {};

/// Whether the next step of a run depends on the radiosity of a solution.
bool isChoosing(const SolveOptions& options) { return options.adaptive || (options.maxError && !boundsRows(options)); }

/// Tells the other ranks how a solution ended.
void tellOtherRanks(radiosity::Messenger& ranks, const radiosity::Solution& solution) {
  std::string bytes;
  radiosity::appendBytes(bytes, solution.isInterrupted);
  radiosity::appendBytes(bytes, solution.radiosity);
  for (int rank = 1; rank < ranks.ranks(); ++rank) ranks.send(rank, radiosity::MessageKind::Solution, bytes);
}

/// What rank 0 tells of its solution.
radiosity::Solution solutionOfRankZero(radiosity::Messenger& ranks) {
  const radiosity::Message message = radiosity::awaited(ranks);
  std::string_view bytes = message.bytes;
  radiosity::Solution solution;
  solution.isInterrupted = radiosity::takeValue<bool>(bytes);
  solution.radiosity = radiosity::takeValue<std::vector<glm::dvec3>>(bytes);
  return solution;
}

/// Gives rows to the solution as rank 0 of several ranks.
radiosity::Solution solvedWithRanks(radiosity::Messenger& ranks, radiosity::SceneFormFactors& drawn,
                                    radiosity::SolveInput input, const radiosity::Progress& progress,
                                    Console& console) {
  radiosity::RowsAhead rows(ranks, drawn, input.settings.rowCacheBytes);
  input.rowOf = [&rows](const radiosity::Patch& patch) { return rows.row(patch); };
  radiosity::Solution solution = radiosity::solve(std::move(input), [&](const radiosity::Step& step) {
    rows.lookAhead(step);
    return progress(step);
  });
  radiosity::endTasks(ranks);
  const radiosity::RowCounts counts = rows.counts();
  console.detail(std::to_string(counts.ahead) + " rows were computed ahead, of which " + std::to_string(counts.used) +
                 " were used; rank 0 computed " + std::to_string(counts.ofRankZero) + " when they were needed");
  return solution;
}

/// Finds the solution of an input.
using Solver = std::function<radiosity::Solution(radiosity::SolveInput input, const radiosity::Progress& progress)>;

/// Solves with the options, discretization and layout of the result, and adds the solution to it. `seen`: see
/// SeenLight.
void solve(SolveResult& result, const radiosity::Scene& scene, Monitor& monitor, const std::vector<bool>& seen = {},
           const Solver& solver = {}) {
  const SolveOptions& options = result.options;
  radiosity::Discretization& discretization = result.discretization;
  // Also used with rays, because patches are split by hemicubes for both methods.
  radiosity::SceneFormFactors drawn(scene, discretization, result.layout, options.drawing);
  if (options.ranks && options.ranks->rank() > 0) {
    radiosity::computeRows(*options.ranks, drawn.rows());
    if (isChoosing(options)) result.solution = solutionOfRankZero(*options.ranks);
    return;
  }
  const std::optional<radiosity::Snapshot> snapshot = monitor.begin();
  result.convergence = {};
  const radiosity::Progress shown = monitor.progressOf(options.solver, result.convergence);
  radiosity::SolveInput input{.scene = scene,
                              .discretization = discretization,
                              .patches = std::move(discretization.patches),
                              .rowOf = drawn.rowOf(),
                              .split = drawn.splits(),
                              .settings = options.solver,
                              .outside = drawn.outsideFlux(),
                              .seen = {seen, drawn.scoutRows()},
                              .snapshot = snapshot ? &*snapshot : nullptr,
                              .isContinued = options.isContinued};
  radiosity::RowCache ofViews(options.solver.rowCacheBytes / 2);
  if (input.isContinued)
    input.rowOf = [&](const radiosity::Patch& patch) { return rowByViews(drawn.rows(), ofViews, patch); };
  std::optional<reference::RayRows> rays;
  if (usesRays(options)) {
    rays.emplace(scene, discretization,
                 reference::RayRowSettings{options.samples, reference::RayStart::Area, options.seed});
    input.rowOf = [&rays](const radiosity::Patch& patch) { return rays->ofPatch(patch); };
  } else {
    result.captured = radiosity::formFactor(drawn.rows().projection().captured);
  }
  std::optional<BoundedRows> bounded;
  if (boundsRows(options)) {
    bounded.emplace(scene, discretization, *options.maxError);
    input.rowOf = [&bounded](const radiosity::Patch& patch) { return bounded->row(patch); };
  }
  if (!options.matrix.empty()) input.rowOf = matrixRows(options.matrix, scene, discretization);
  if (bounded || !options.matrix.empty()) {
    input.split = {};
    result.captured = 1;
  }
  const radiosity::Progress progress = [&](const radiosity::Step& step) {
    if (bounded) bounded->lookAhead(step);
    return shown(step);
  };
  result.solution = solver ? solver(std::move(input), progress)
                    : options.ranks
                        ? solvedWithRanks(*options.ranks, drawn, std::move(input), progress, monitor.console())
                        : radiosity::solve(std::move(input), progress);
  monitor.console().endProgress();
  if (bounded) result.rowErrors = bounded->errors();
  if (options.ranks && isChoosing(options)) tellOtherRanks(*options.ranks, result.solution);
  discretization.patches = std::move(result.solution.patches);
  if (result.solution.continuation) result.solution.continuation->rows.ofViews = std::move(ofViews);
}

/// As `solve` for a choice of settings, which goes on with the radiosity. Throws Stopped after a signal.
const std::vector<glm::dvec3>& solvedRadiosity(SolveResult& result, const radiosity::Scene& scene, Monitor& monitor,
                                               const std::vector<bool>& seen = {}) {
  solve(result, scene, monitor, seen);
  if (result.solution.isInterrupted) throw Stopped();
  return result.solution.radiosity;
}

/// The surfaces that are seen in a picture of the proportions of render.png, with 256 pixels along its longer side.
std::vector<bool> seenIn(const CameraOptions& picture, const radiosity::Scene& scene, const radiosity::Camera& camera) {
  const auto scaled = [longer = std::max(picture.width, picture.height)](int side) {
    return std::max(1, 256 * side / longer);
  };
  return radiosity::seenSurfaces(scene, camera, scaled(picture.width), scaled(picture.height));
}

/// Solves with growing effort until both expected errors are within --max-error.
void solveBounded(SolveResult& result, const radiosity::Scene& scene, const radiosity::Camera& camera,
                  Monitor& monitor) {
  const std::vector<bool> seen = seenIn(result.options.camera, scene, camera);
  const double bound = *result.options.maxError;
  result.options.solver.residual = radiosity::residualFor(bound);
  const radiosity::Patches unsplit = result.discretization.patches;
  const auto solveWith = [&](const radiosity::Effort& effort) {
    result.options.drawing.resolution = effort.resolution;
    result.options.drawing.split = effort.split;
    result.discretization.patches = unsplit;
    return solvedRadiosity(result, scene, monitor, seen);
  };
  result.expectedErrors = radiosity::chooseEffort(result.discretization, seen, solveWith, bound).expectedErrors;
}

/// Solves with elements that become smaller where radiosity changes fast.
void solveAdaptive(SolveResult& result, const radiosity::Scene& scene, Monitor& monitor) {
  const SolveOptions& options = result.options;
  const auto solveElements = [&](const radiosity::Discretization& discretization) {
    result.discretization = discretization;
    result.layout = layoutOf(options.id, discretization);
    return solvedRadiosity(result, scene, monitor);
  };
  solveElements(radiosity::adaptiveDiscretization(scene, options.discretization, *options.adaptive, solveElements));
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

}  // namespace

SolveResult solveBands(const SolveOptions& asked, const BandScenes& scenes, radiosity::Discretization discretization,
                       Monitor& monitor) {
  SolveResult result{asked, std::move(discretization)};
  result.layout = layoutOf(asked.id, result.discretization);
  radiosity::Scene scene = scenes.inColour;
  const auto solver = [&](radiosity::SolveInput input, const radiosity::Progress& progress) {
    result.bands = solvedGroups(scenes, scene, result.discretization, std::move(input), progress);
    radiosity::averageMaps(scenes.inColour, result.discretization);
    radiosity::Solution inColour = radiosity::inColour(scenes.inColour, result.discretization, *result.bands);
    inColour.patches = std::move(result.bands->groups.back().patches);
    return inColour;
  };
  solve(result, scene, monitor, {}, solver);
  return result;
}

SolveResult solveScene(const SolveOptions& asked, const radiosity::Scene& scene, const radiosity::Camera& camera,
                       radiosity::Discretization discretization, Monitor& monitor) {
  SolveResult result{asked, std::move(discretization)};
  if (boundsRows(asked)) result.options.solver.residual = radiosity::residualFor(*asked.maxError);
  if (!asked.adaptive) result.layout = layoutOf(asked.id, result.discretization);
  try {
    if (asked.adaptive)
      solveAdaptive(result, scene, monitor);
    else if (asked.maxError && !boundsRows(asked))
      solveBounded(result, scene, camera, monitor);
    else
      solve(result, scene, monitor);
  } catch (const Stopped&) {  // the last solution is the result
  }
  return result;
}

}  // namespace hemitex::cli
