#include "radiosity/light/light.h"

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "radiosity/base/bytes.h"
#include "radiosity/discretization/adaptive_subdivision.h"
#include "radiosity/ranks/shared_tasks.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

/// Ends a choice between two of its solutions. Thrown and caught in this file.
struct Stopped {};

/// Tells the other ranks how a solution ended.
void tellOtherRanks(Messenger& ranks, const Solution& solution) {
  std::string bytes;
  appendBytes(bytes, solution.isInterrupted);
  appendBytes(bytes, solution.shots);
  appendBytes(bytes, solution.radiosity);
  for (int rank = 1; rank < ranks.ranks(); ++rank) ranks.send(rank, MessageKind::Solution, bytes);
}

/// What rank 0 tells of its solution.
Solution solutionOfRankZero(Messenger& ranks) {
  const Message message = awaited(ranks);
  std::string_view bytes = message.bytes;
  Solution solution;
  solution.isInterrupted = takeValue<bool>(bytes);
  solution.shots = takeValue<int>(bytes);
  solution.radiosity = takeValue<std::vector<glm::dvec3>>(bytes);
  return solution;
}

/// The solutions of a scene, one or those of a choice. Each sets the members of the result.
class Solutions {
 public:
  Solutions(const Scene& scene, const LightHooks& hooks, Light& result)
      : scene_(scene), hooks_(hooks), result_(result) {}

  /// Solves with the settings and elements of the result.
  void solve() {
    const LightSettings& settings = result_.settings;
    result_.layout = hooks_.layOut(result_.discretization);
    SceneFormFactors drawn(scene_, result_.discretization, result_.layout, settings.drawing, hooks_.makeRenderer);
    const bool isChoosing = settings.maxError || settings.adaptive;
    if (hooks_.ranks && hooks_.ranks->rank() > 0) {
      if (sharesRows()) computeRows(*hooks_.ranks, drawn.uncorrected());
      if (isChoosing) result_.solution = solutionOfRankZero(*hooks_.ranks);
      return;
    }
    solveWith(drawn);
    if (hooks_.ranks && isChoosing) tellOtherRanks(*hooks_.ranks, result_.solution);
  }

  /// As `solve` for a choice, which goes on with the radiosity. Throws Stopped if the progress ended the solution.
  const std::vector<glm::dvec3>& radiosity() {
    solve();
    if (result_.solution.isInterrupted) throw Stopped();
    return result_.solution.radiosity;
  }

 private:
  /// Other ranks compute drawn rows alone.
  bool sharesRows() const { return hooks_.ranks && !hooks_.rows; }

  SeenLight seenLight(SceneFormFactors& drawn) const {
    const LightSettings& settings = result_.settings;
    if (!settings.maxError) return {settings.seen};
    return {settings.seen, drawn.scoutRows(), settings.solver.residual};
  }

  void solveWith(SceneFormFactors& drawn) {
    const LightSettings& settings = result_.settings;
    OutsideFlux outside = drawn.outsideFlux();
    if (settings.isResidualDefault && !settings.maxError)
      result_.settings.solver.residual = defaultResidual(scene_, result_.discretization, outside);
    const SolutionStart start = hooks_.start ? hooks_.start(settings.solver) : SolutionStart();
    RowCache ofViews(settings.solver.rowCacheBytes / 2);
    PatchRows rows{.rowOf = drawn.rowOf(),
                   .split = drawn.splits(),
                   .captured = formFactor(drawn.uncorrected().projection().captured)};
    if (settings.isContinued) rows.rowOf = [&](const Patch& patch) { return rowByViews(drawn, ofViews, patch); };
    const bool isFasterTogether = !settings.isContinued && drawn.uncorrected().areFasterTogether();
    std::optional<RowsAhead> ahead;
    if (sharesRows() || isFasterTogether) {
      ahead.emplace(sharesRows() ? hooks_.ranks : nullptr, drawn, settings.solver.rowCacheBytes);
      rows.rowOf = [&](const Patch& patch) { return ahead->row(patch); };
      rows.prepare = [&](const NextShots& next) { ahead->lookAhead(next); };
    }
    if (hooks_.rows) rows = hooks_.rows(std::move(rows), scene_, result_.discretization);
    SolveInput input{.scene = scene_,
                     .discretization = result_.discretization,
                     .patches = std::move(result_.discretization.patches),
                     .rowOf = rows.rowOf,
                     .split = rows.split,
                     .prepare = rows.prepare,
                     .settings = settings.solver,
                     .outside = std::move(outside),
                     .seen = seenLight(drawn),
                     .snapshot = start.snapshot ? &*start.snapshot : nullptr,
                     .isContinued = settings.isContinued};
    result_.solution =
        hooks_.solve ? hooks_.solve(std::move(input)) : radiosity::solve(std::move(input), start.progress);
    if (sharesRows()) {
      endTasks(*hooks_.ranks);
      result_.rowsAhead = ahead->counts();
    }
    result_.captured = rows.captured;
    result_.discretization.patches = std::move(result_.solution.patches);
    if (auto& continuation = result_.solution.continuation) {
      continuation->rows.ofViews = std::move(ofViews);
      if (NearReceivers* near = drawn.near()) continuation->rows.near = std::move(near->known());
    }
  }

  const Scene& scene_;
  const LightHooks& hooks_;
  Light& result_;
};

/// Solves with growing effort until both expected errors are within the bound.
void solveBounded(Light& result, Solutions& solutions) {
  LightSettings& settings = result.settings;
  settings.solver.residual = residualFor(*settings.maxError);
  if (settings.residual) settings.solver.residual = std::min(settings.solver.residual, *settings.residual);
  const Patches unsplit = result.discretization.patches;
  const auto solveWith = [&](const Effort& effort) {
    settings.drawing.resolution = effort.resolution;
    settings.drawing.split = effort.split;
    result.discretization.patches = unsplit;
    return solutions.radiosity();
  };
  const auto isLast = [&] { return endOf(result.solution, settings.solver) == "shots"; };
  result.expectedErrors =
      chooseEffort(result.discretization, settings.seen, solveWith, *settings.maxError, {settings.coarsest, isLast})
          .expectedErrors;
}

/// Elements that become smaller where radiosity changes fast.
Discretization adaptiveElements(const Scene& scene, Light& result, Solutions& solutions) {
  const auto solveElements = [&](const Discretization& discretization) {
    result.discretization = discretization;
    return solutions.radiosity();
  };
  const LightSettings& settings = result.settings;
  return adaptiveDiscretization(scene, settings.elements, *settings.adaptive, solveElements);
}

}  // namespace

Light light(const Scene& scene, Discretization discretization, const LightSettings& settings, const LightHooks& hooks) {
  if (settings.maxError && (hooks.rows || settings.drawing.projection != ProjectionKind::Hemicube))
    throw raster::InputError("the error of a solution is bounded with hemicubes alone", "omit the method or the bound");
  if (settings.maxError) requireEfforts(settings.coarsest);
  Light result{settings, std::move(discretization)};
  Solutions solutions(scene, hooks, result);
  try {
    if (settings.adaptive) result.discretization = adaptiveElements(scene, result, solutions);
    if (settings.maxError)
      solveBounded(result, solutions);
    else
      solutions.solve();
  } catch (const Stopped&) {  // the last solution is the result
  }
  return result;
}

DynamicSolution editable(Scene scene, Light light, const LightHooks& hooks) {
  const LightSettings& settings = light.settings;
  return {std::move(scene),
          std::move(light.discretization),
          std::move(light.solution),
          {settings.elements, settings.drawing, settings.solver, hooks.rows},
          hooks.layOut,
          hooks.makeRenderer};
}

}  // namespace hemitex::radiosity
