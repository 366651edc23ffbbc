#include "cli/solve/monitor.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "cli/common/json.h"
#include "cli/common/numbers.h"
#include "reference/base/stopwatch.h"

namespace hemitex::cli {
namespace {

constexpr std::chrono::milliseconds showInterval{100};

/// The number of shots after which half of the time had passed.
std::size_t shotsAtHalfTime(const Convergence& convergence) {
  const std::vector<double>& seconds = convergence.seconds;
  const auto half = std::lower_bound(seconds.begin(), seconds.end(), seconds.back() / 2);
  return static_cast<std::size_t>(half - seconds.begin());
}

/// The seconds until a solution with a number of shots is at a limit of its settings, from its convergence in the
/// second half of the time so far; nothing if it does not converge. The residual decreases about exponentially with
/// time.
std::optional<double> secondsLeft(const radiosity::SolverSettings& settings, int shots,
                                  const Convergence& convergence) {
  const std::size_t half = shotsAtHalfTime(convergence), last = convergence.seconds.size() - 1;
  const double seconds = convergence.seconds[last] - convergence.seconds[half];
  if (half == last || !(seconds > 0)) return std::nullopt;
  std::optional<double> left;
  if (settings.shots) left = (*settings.shots - shots) * seconds / static_cast<double>(last - half);
  const double decay = std::log(convergence.residual[half] / convergence.residual[last]) / seconds;
  if (decay > 0 && settings.residual > 0) {
    const double untilResidual = std::log(convergence.residual[last] / settings.residual) / decay;
    left = std::min(left.value_or(untilResidual), untilResidual);
  }
  if (left) left = std::max(*left, 0.0);
  return left;
}

}  // namespace

Monitor::Monitor(Console& console, const LongRunOptions& options, const radiosity::Scene& scene,
                 const std::string& settings, const std::set<std::filesystem::path>& inputs)
    : console_(console), isForPrograms_(options.isForPrograms), checkpoint_(options, scene, settings, inputs) {}

radiosity::Progress Monitor::progressOf(const radiosity::SolverSettings& settings, Convergence& convergence) {
  return [this, &settings, &convergence, watch = reference::Stopwatch()](const radiosity::Step& step) {
    if (!run_) run_.emplace();
    convergence.residual.push_back(step.residual);
    convergence.seconds.push_back(watch.seconds());
    show(settings, step, convergence);
    const bool isStopping = LongRun::isStopping();
    checkpoint_.update(step, isStopping);
    return !isStopping;
  };
}

/// The fraction is the share of the requested shots, or of the residual's decrease on a logarithmic scale.
void Monitor::show(const radiosity::SolverSettings& settings, const radiosity::Step& step,
                   const Convergence& convergence) {
  const auto now = std::chrono::steady_clock::now();
  if (now - shown_ < showInterval && !(isForPrograms_ && step.isLast)) return;
  shown_ = now;
  const double rate = static_cast<double>(convergence.seconds.size()) / convergence.seconds.back();
  const std::optional<double> left = secondsLeft(settings, step.shots, convergence);
  if (isForPrograms_) {
    const nlohmann::ordered_json line = {
        {"shots", step.shots}, {"residual", step.residual}, {"shots_per_s", rate}, {"left_s", orNull(left)}};
    console_.machineLine(toLine(line));
    return;
  }
  const double fraction = settings.shots ? static_cast<double>(step.shots) / *settings.shots
                                         : std::log(step.residual) / std::log(settings.residual);
  console_.progress(fraction, "shot " + std::to_string(step.shots) + ", " + roundedText(rate) + " shots/s, " +
                                  percentText(step.residual) + " of the flux unshot" +
                                  (left ? ", " + roundedText(*left) + " s left" : ""));
}

}  // namespace hemitex::cli
