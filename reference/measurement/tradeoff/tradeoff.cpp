#include "reference/measurement/tradeoff/tradeoff.h"

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>

#include "radiosity/discretization/discretize.h"

namespace hemitex::reference {
namespace {

using radiosity::Discretization;
using radiosity::FormFactorRow;
using radiosity::Scene;
using Rows = std::vector<std::optional<FormFactorRow>>;

std::vector<double> patchFlux(const Discretization& fine, const TrueRadiosity& truth, const Discretization& coarse) {
  const std::vector<std::uint32_t> under = elementsUnder(coarse, fine);
  std::vector<double> flux(coarse.patches.list.size());
  for (std::size_t e = 0; e < under.size(); ++e) {
    const glm::dvec3& radiosity = truth.radiosity[e];
    flux[coarse.patches.ofElement[under[e]]] += fine.elements[e].area * (radiosity.x + radiosity.y + radiosity.z);
  }
  return flux;
}

std::size_t bytesOf(const Rows& rows) {
  std::size_t bytes = 0;
  for (const std::optional<FormFactorRow>& row : rows)
    if (row) bytes += row->elements.size() * (sizeof row->elements[0] + sizeof row->shares[0]);
  return bytes;
}

struct TimedSolution {
  radiosity::Light light;
  double seconds = 0;
  std::size_t rowCount = 0, rowBytes = 0;  ///< of the patches that shot
  Rows rows;                               ///< of all patches
};

/// The rows of patches that did not shoot are computed after the time is taken.
TimedSolution timedSolution(const Scene& scene, const TradeMethod& method, const TradeChoice& choice,
                            const radiosity::RendererFactory& makeRenderer) {
  TimedSolution timed;
  Rows& rows = timed.rows;
  const TradeRows source = method.rows(choice.setting);
  radiosity::RowSource rowOf;
  const Stopwatch watch;
  const radiosity::LightHooks hooks{
      .makeRenderer = makeRenderer,
      .rows =
          [&](radiosity::PatchRows drawn, const Scene& of, const Discretization& elements) {
            radiosity::PatchRows found = source.others ? source.others(drawn, of, elements) : std::move(drawn);
            rowOf = found.rowOf;
            found.rowOf = [&](const radiosity::Patch& patch) {
              if (rows.size() <= patch.number) rows.resize(patch.number + 1);
              rows[patch.number] = rowOf(patch);
              return *rows[patch.number];
            };
            return found;
          },
      .solve =
          [&](radiosity::SolveInput input) {
            radiosity::Solution solution = radiosity::solve(std::move(input));
            timed.seconds = watch.seconds();
            timed.rowCount = static_cast<std::size_t>(
                std::count_if(rows.begin(), rows.end(), [](const auto& row) { return row.has_value(); }));
            timed.rowBytes = bytesOf(rows);
            rows.resize(solution.patches.list.size());
            for (const radiosity::Patch& patch : solution.patches.list)
              if (!rows[patch.number]) rows[patch.number] = rowOf(patch);
            return solution;
          }};
  timed.light = radiosity::light(scene, radiosity::discretize(scene, {.texels = choice.texels, .patch = choice.patch}),
                                 {.drawing = source.drawing, .solver = {.residual = tradeResidual}}, hooks);
  return timed;
}

std::size_t bytesOf(const Discretization& discretization) {
  std::size_t bytes = discretization.elements.size() * (sizeof(radiosity::Element) + 2 * sizeof(glm::dvec3)) +
                      discretization.patches.list.size() * sizeof(radiosity::Patch);
  for (const radiosity::Grid& grid : discretization.grids)
    bytes += grid.elementOfTexel.size() * sizeof grid.elementOfTexel[0];
  return bytes;
}

/// Computes all results except times.
TradeMeasurement judge(const Discretization& fine, const TrueRadiosity& truth, const TradeMethod& method,
                       const TradeChoice& choice, TimedSolution& timed) {
  const Discretization& discretization = timed.light.discretization;
  TradeMeasurement measurement;
  measurement.choice = choice;
  measurement.elements = discretization.elements.size();
  measurement.patches = discretization.patches.list.size();
  measurement.rows = timed.rowCount;
  measurement.shots = timed.light.solution.shots;
  measurement.error =
      errorOf(fine, onOtherGrids(discretization, timed.light.solution.radiosity, fine), truth.radiosity);
  measurement.bufferBytes = method.bufferBytes(choice.setting);
  measurement.rowBytes = timed.rowBytes;
  measurement.elementBytes = bytesOf(discretization);
  const std::vector<double> flux = patchFlux(fine, truth, discretization);
  measurement.rowError =
      rowError(denseRows(timed.rows, discretization), denseRows(truth.matrix, fine, discretization), flux);
  measurement.radiosity = std::move(timed.light.solution.radiosity);
  return measurement;
}

}  // namespace

std::vector<TradeChoice> tradeChoices(const std::vector<TradeMethod>& methods, const std::vector<int>& texels,
                                      const std::vector<int>& patches) {
  assert(!texels.empty() && !patches.empty());
  std::vector<TradeChoice> choices;
  for (std::size_t m = 0; m < methods.size(); ++m) {
    const std::vector<int>& settings = methods[m].measured;
    for (const int setting : settings) choices.push_back({m, setting, texels.front(), patches.front()});
    for (const int t : texels)
      for (const int p : patches) {
        if (p > t || std::pair{t, p} == std::pair{texels.front(), patches.front()}) continue;
        for (std::size_t i = 0; i <= settings.size() / 2; ++i) choices.push_back({m, settings[i], t, p});
      }
  }
  return choices;
}

void markFront(std::vector<TradeMeasurement>& measurements) {
  const auto isBetter = [](const TradeMeasurement& a, const TradeMeasurement& b) {
    const double seconds = a.seconds.median - b.seconds.median, error = a.error.fluxWeighted - b.error.fluxWeighted;
    return seconds <= 0 && error <= 0 && (seconds < 0 || error < 0);
  };
  for (TradeMeasurement& one : measurements)
    one.isOnFront = std::none_of(measurements.begin(), measurements.end(),
                                 [&](const TradeMeasurement& other) { return isBetter(other, one); });
}

std::vector<TradeMeasurement> measureTradeoff(const Scene& scene, const Discretization& fine,
                                              const TrueRadiosity& truth, const std::vector<TradeMethod>& methods,
                                              const std::vector<TradeChoice>& choices,
                                              const std::function<void(std::size_t, std::size_t)>& progress,
                                              const radiosity::RendererFactory& makeRenderer) {
  std::vector<TradeMeasurement> measurements;
  const auto secondsOf = [&](std::size_t i, int round) {
    if (progress) progress(static_cast<std::size_t>(round) * choices.size() + i, choices.size() * tradeRounds);
    const TradeMethod& method = methods[choices[i].method];
    TimedSolution timed = timedSolution(scene, method, choices[i], makeRenderer);
    if (round == 0) measurements.push_back(judge(fine, truth, method, choices[i], timed));
    return timed.seconds;
  };
  const std::vector<Timing> timings = interleavedTimings(choices.size(), tradeRounds, secondsOf, longTime);
  for (std::size_t i = 0; i < timings.size(); ++i) measurements[i].seconds = timings[i];
  markFront(measurements);
  return measurements;
}

RowError trueRowError(const Discretization& fine, const TrueRadiosity& truth, const Discretization& discretization) {
  const DenseRows trueRows = denseRows(truth.matrix, fine, discretization);
  DenseRows moved = denseRows(truth.spread, fine, discretization);
  for (std::size_t i = 0; i < moved.factors.size(); ++i) moved.factors[i] += trueRows.factors[i];
  return rowError(moved, trueRows, patchFlux(fine, truth, discretization));
}

}  // namespace hemitex::reference
