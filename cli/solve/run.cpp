#include "cli/solve/run.h"

#include <cmath>

#include "cli/common/interruption.h"
#include "cli/common/json.h"
#include "radiosity/discretization/adaptive_subdivision.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/ranks/message_bytes.h"
#include "radiosity/ranks/rows_ahead.h"
#include "radiosity/ranks/shared_tasks.h"
#include "radiosity/solver/error_control.h"
#include "reference/bench/timing.h"
#include "reference/rays/embree_form_factors.h"

namespace hemitex::cli {

std::optional<BoundedSolution> solvedWithin(const SolveOptions& asked, const radiosity::Scene& scene,
                                            const radiosity::Discretization& discretization,
                                            const radiosity::IdLayout& layout, Console& console) {
  if (!asked.maxError) return std::nullopt;
  BoundedSolution bounded{asked};
  bounded.options.solver.residual = radiosity::residualFor(*asked.maxError);
  const auto solveWith = [&](const radiosity::Effort& effort) {
    bounded.options.drawing.resolution = effort.resolution;
    bounded.options.drawing.split = effort.split;
    bounded.solved = solvedBy(bounded.options, scene, discretization, layout, console);
    return bounded.solved.solution.radiosity;
  };
  bounded.expectedError = radiosity::chooseEffort(discretization, solveWith, *asked.maxError).expectedError;
  return bounded;
}

radiosity::Discretization discretizationFor(const SolveOptions& options, const radiosity::Scene& scene,
                                            Console& console) {
  if (!options.adaptive) return discretizationOf(options.discretization, scene);
  const auto solveElements = [&](const radiosity::Discretization& discretization) {
    const radiosity::IdLayout layout = layoutOf(options.id, discretization, console);
    return solvedBy(options, scene, discretization, layout, console).solution.radiosity;
  };
  return radiosity::adaptiveDiscretization(scene, options.discretization, *options.adaptive, solveElements);
}

namespace {

/// Sends the radiosity to the other ranks: with some options, the next step of all ranks depends on it.
void toOtherRanks(radiosity::Messenger& ranks, const std::vector<glm::dvec3>& radiosity) {
  radiosity::MessageWriter message;
  message.add(radiosity);
  const std::string bytes = message.take();
  for (int rank = 1; rank < ranks.ranks(); ++rank) ranks.send(rank, radiosity::MessageKind::Solution, bytes);
}
std::vector<glm::dvec3> fromRankZero(radiosity::Messenger& ranks) {
  return radiosity::MessageReader(radiosity::awaited(ranks).bytes).list<glm::dvec3>();
}

std::string textOf(const radiosity::RowCounts& counts) {
  return std::to_string(counts.ahead) + " rows were computed ahead, of which " + std::to_string(counts.used) +
         " were used; rank 0 computed " + std::to_string(counts.ofRankZero) + " when they were needed";
}

}  // namespace

Solved solvedBy(const SolveOptions& options, const radiosity::Scene& scene, radiosity::Discretization discretization,
                const radiosity::IdLayout& layout, Console& console) {
  // Also used with rays, because patches are split by hemicubes for both methods.
  radiosity::SceneFormFactors drawn(scene, std::move(discretization), layout, options.drawing);
  if (options.ranks != nullptr && options.ranks->rank() > 0) {
    radiosity::computeRows(*options.ranks, drawn.rows());
    Solved solved{drawn.discretization(), {}};
    solved.solution.radiosity = fromRankZero(*options.ranks);
    return solved;
  }
  Convergence convergence;
  const auto solveBy = [&](auto& rows) {
    const auto rowOf = [&rows](std::uint32_t patch) { return rows.ofPatch(patch); };
    radiosity::Solution solution = radiosity::solve(scene, drawn.discretization(), rowOf, options.solver,
                                                    recording(convergence, progressOf(options.solver, console)),
                                                    drawn.splits(), drawn.outsideFlux());
    console.endProgress();
    return solution;
  };
  const auto solveByRanks = [&] {
    radiosity::RowsAhead rows(*options.ranks, drawn, options.solver.rowCacheBytes);
    radiosity::Solution solution = radiosity::solve(
        scene, drawn.discretization(), [&rows](std::uint32_t patch) { return rows.row(patch); }, options.solver,
        recording(convergence, progressOf(options.solver, console)), drawn.splits(), drawn.outsideFlux(),
        [&rows](const auto& likelyShots) { rows.lookAhead(likelyShots); });
    console.endProgress();
    rows.end();
    console.detail(textOf(rows.counts()));
    toOtherRanks(*options.ranks, solution.radiosity);
    return solution;
  };
  if (usesRays(options)) {
    reference::RayRows rows(scene, drawn.discretization(),
                            {.rays = options.samples, .start = reference::RayStart::Area});
    radiosity::Solution solution = solveBy(rows);
    return {drawn.discretization(), std::move(solution), 1, std::move(convergence)};
  }
  radiosity::Solution solution = options.ranks != nullptr ? solveByRanks() : solveBy(drawn.rows());
  return {drawn.discretization(), std::move(solution), radiosity::formFactor(drawn.rows().projection().captured),
          std::move(convergence)};
}

std::unique_ptr<radiosity::DynamicSolution> dynamicSolution(const SolveOptions& options, const radiosity::Scene& scene,
                                                            radiosity::Discretization discretization,
                                                            Convergence& convergence, Console& console) {
  const auto layOut = [&id = options.id, &console](const radiosity::Discretization& edited) {
    return layoutOf(id, edited, console);
  };
  auto dynamic = std::make_unique<radiosity::DynamicSolution>(
      scene, std::move(discretization),
      radiosity::DynamicSettings{options.discretization, options.drawing, options.solver}, layOut,
      recording(convergence, progressOf(options.solver, console)));
  console.endProgress();
  return dynamic;
}

Solved solvedBy(const radiosity::DynamicSolution& dynamic) {
  return {dynamic.discretization(), dynamic.solution(), radiosity::formFactor(dynamic.captured())};
}

radiosity::Progress progressOf(const radiosity::SolverSettings& settings, Console& console) {
  return [&settings, &console](int shots, double residual) {
    const double fraction = settings.shots ? static_cast<double>(shots) / *settings.shots
                                           : std::log(residual) / std::log(settings.residual);
    console.progress(fraction, "shot " + std::to_string(shots) + ", " + percentText(residual) + " of the flux unshot");
    return !LongRun::isStopping();
  };
}

radiosity::Progress recording(Convergence& convergence, radiosity::Progress progress) {
  return [&convergence, progress = std::move(progress), watch = reference::Stopwatch()](int shots, double residual) {
    convergence.residual.push_back(residual);
    convergence.seconds.push_back(watch.seconds());
    return progress(shots, residual);
  };
}

}  // namespace hemitex::cli
