#include "cli/solve/run.h"

#include "radiosity/base/bytes.h"
#include "radiosity/discretization/adaptive_subdivision.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/ranks/rows_ahead.h"
#include "radiosity/ranks/shared_tasks.h"
#include "radiosity/solver/error_control.h"
#include "reference/truth/rays/embree_form_factors.h"

namespace hemitex::cli {
namespace {

/// Ends a choice of settings between two of its solutions. Thrown and caught in this file.
struct Stopped {};

/// Whether the next step of a run depends on the radiosity of a solution.
bool isChoosing(const SolveOptions& options) { return options.adaptive || options.maxError; }

/// Tells the other ranks how a solution ended.
void tellOtherRanks(radiosity::Messenger& ranks, const radiosity::Solution& solution) {
  std::string bytes;
  radiosity::appendBytes(bytes, solution.isInterrupted);
  radiosity::appendList(bytes, solution.radiosity);
  for (int rank = 1; rank < ranks.ranks(); ++rank) ranks.send(rank, radiosity::MessageKind::Solution, bytes);
}

/// What rank 0 tells of its solution.
radiosity::Solution solutionOfRankZero(radiosity::Messenger& ranks) {
  const radiosity::Message message = radiosity::awaited(ranks);
  std::string_view bytes = message.bytes;
  radiosity::Solution solution;
  solution.isInterrupted = radiosity::takeValue<bool>(bytes);
  solution.radiosity = radiosity::takeList<glm::dvec3>(bytes);
  return solution;
}

std::string textOf(const radiosity::RowCounts& counts) {
  return std::to_string(counts.ahead) + " rows were computed ahead, of which " + std::to_string(counts.used) +
         " were used; rank 0 computed " + std::to_string(counts.ofRankZero) + " when they were needed";
}

Solved solvedBy(const SolveOptions& options, const radiosity::Scene& scene, radiosity::Discretization discretization,
                const radiosity::IdLayout& layout, Monitor& monitor) {
  // Also used with rays, because patches are split by hemicubes for both methods.
  radiosity::SceneFormFactors drawn(scene, std::move(discretization), layout, options.drawing);
  if (options.ranks && options.ranks->rank() > 0) {
    radiosity::computeRows(*options.ranks, drawn.rows());
    return {drawn.takeDiscretization(),
            isChoosing(options) ? solutionOfRankZero(*options.ranks) : radiosity::Solution()};
  }
  const std::optional<radiosity::Snapshot> snapshot = monitor.begin();
  Convergence convergence;
  const auto solveBy = [&](const radiosity::RowSource& rowOf, const radiosity::LookAhead& lookAhead = {}) {
    radiosity::Solution solution = radiosity::solve(
        scene, drawn.discretization(), rowOf, options.solver, monitor.progressOf(options.solver, convergence),
        drawn.splits(), {.outside = drawn.outsideFlux(), .snapshot = snapshot ? &*snapshot : nullptr}, lookAhead);
    monitor.console().endProgress();
    return solution;
  };
  const auto solveAlone = [&](auto& rows) {
    return solveBy([&rows](std::uint32_t patch) { return rows.ofPatch(patch); });
  };
  const auto solveWithRanks = [&](radiosity::Messenger& ranks) {
    radiosity::RowsAhead rows(ranks, drawn, options.solver.rowCacheBytes);
    radiosity::Solution solution = solveBy([&rows](std::uint32_t patch) { return rows.row(patch); },
                                           [&rows](const auto& likelyShots) { rows.lookAhead(likelyShots); });
    rows.end();
    monitor.console().detail(textOf(rows.counts()));
    if (isChoosing(options)) tellOtherRanks(ranks, solution);
    return solution;
  };
  if (usesRays(options)) {
    reference::RayRows rows(scene, drawn.discretization(),
                            {.rays = options.samples, .start = reference::RayStart::Area, .seed = options.seed});
    radiosity::Solution solution = solveAlone(rows);
    return {drawn.takeDiscretization(), std::move(solution), 1, std::move(convergence)};
  }
  radiosity::Solution solution = options.ranks ? solveWithRanks(*options.ranks) : solveAlone(drawn.rows());
  const double captured = radiosity::formFactor(drawn.rows().projection().captured);
  return {drawn.takeDiscretization(), std::move(solution), captured, std::move(convergence)};
}

/// Solves with growing effort until the expected error is within --max-error.
Outcome boundedOutcome(const SolveOptions& asked, const radiosity::Scene& scene,
                       const radiosity::Discretization& discretization, Monitor& monitor) {
  Outcome outcome{asked, layoutOf(asked.id, discretization, monitor.console())};
  outcome.options.solver.residual = radiosity::residualFor(*asked.maxError);
  const auto solveWith = [&](const radiosity::Effort& effort) {
    outcome.options.drawing.resolution = effort.resolution;
    outcome.options.drawing.split = effort.split;
    outcome.solved = solvedBy(outcome.options, scene, discretization, outcome.layout, monitor);
    if (outcome.solved.solution.isInterrupted) throw Stopped();
    return outcome.solved.solution.radiosity;
  };
  try {
    outcome.expectedError = radiosity::chooseEffort(discretization, solveWith, *asked.maxError).expectedError;
  } catch (const Stopped&) {  // the last solution is the outcome
  }
  return outcome;
}

/// Solves with elements that become smaller where radiosity changes fast.
Outcome adaptiveOutcome(const SolveOptions& asked, const radiosity::Scene& scene, Monitor& monitor) {
  Outcome outcome{asked};
  const auto solve = [&](const radiosity::Discretization& discretization) {
    outcome.layout = layoutOf(asked.id, discretization, monitor.console());
    outcome.solved = solvedBy(asked, scene, discretization, outcome.layout, monitor);
  };
  const auto solveElements = [&](const radiosity::Discretization& discretization) {
    solve(discretization);
    if (outcome.solved.solution.isInterrupted) throw Stopped();
    return outcome.solved.solution.radiosity;
  };
  try {
    solve(radiosity::adaptiveDiscretization(scene, asked.discretization, *asked.adaptive, solveElements));
  } catch (const Stopped&) {  // the last solution is the outcome
  }
  return outcome;
}

Outcome plainOutcome(const SolveOptions& asked, const radiosity::Scene& scene, radiosity::Discretization discretization,
                     Monitor& monitor) {
  Outcome outcome{asked, layoutOf(asked.id, discretization, monitor.console())};
  outcome.solved = solvedBy(asked, scene, std::move(discretization), outcome.layout, monitor);
  return outcome;
}

/// Solves the scene for later edits.
Outcome editableOutcome(Outcome outcome, const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                        Monitor& monitor) {
  const auto layOut = [id = outcome.options.id, &monitor](const radiosity::Discretization& edited) {
    return layoutOf(id, edited, monitor.console());
  };
  const SolveOptions& options = outcome.options;
  Convergence convergence;
  outcome.dynamic = std::make_unique<radiosity::DynamicSolution>(
      scene, discretization, radiosity::DynamicSettings{options.discretization, options.drawing, options.solver},
      layOut, monitor.progressOf(options.solver, convergence));
  monitor.console().endProgress();
  const radiosity::DynamicSolution& dynamic = *outcome.dynamic;
  outcome.layout = dynamic.layout();
  outcome.solved = {dynamic.discretization(), dynamic.solution(), radiosity::formFactor(dynamic.captured()),
                    std::move(convergence)};
  return outcome;
}

}  // namespace

Outcome solveScene(const SolveOptions& asked, const radiosity::Scene& scene, radiosity::Discretization discretization,
                   Monitor& monitor) {
  if (asked.adaptive) return adaptiveOutcome(asked, scene, monitor);
  if (asked.edits.empty())
    return asked.maxError ? boundedOutcome(asked, scene, discretization, monitor)
                          : plainOutcome(asked, scene, std::move(discretization), monitor);
  Outcome chosen = asked.maxError ? boundedOutcome(asked, scene, discretization, monitor) : Outcome{asked};
  if (chosen.solved.solution.isInterrupted) return chosen;
  return editableOutcome(std::move(chosen), scene, discretization, monitor);
}

}  // namespace hemitex::cli
