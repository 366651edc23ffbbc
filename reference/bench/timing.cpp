#include "reference/bench/timing.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace hemitex::reference {
namespace {

/// Seconds of the mean call, of as many as take `shortest` seconds.
double secondsOf(const std::function<void()>& task, double shortest) {
  const Stopwatch watch;
  int calls = 0;
  double seconds = 0;
  do {
    task();
    ++calls;
    seconds = watch.seconds();
  } while (seconds < shortest);
  return seconds / calls;
}

}  // namespace

double medianOf(std::vector<double> values) {
  assert(!values.empty());
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

Timing timingOf(std::vector<double> turns) {
  const double median = medianOf(turns), least = *std::min_element(turns.begin(), turns.end());
  return {median, least, std::move(turns)};
}

Timing operator/(const Timing& timing, double parts) {
  Timing part{timing.median / parts, timing.least / parts, timing.turns};
  for (double& seconds : part.turns) seconds /= parts;
  return part;
}

std::vector<double> quotients(std::span<const double> turns, std::span<const double> others) {
  assert(turns.size() == others.size());
  std::vector<double> result;
  for (std::size_t turn = 0; turn < turns.size(); ++turn) result.push_back(turns[turn] / others[turn]);
  return result;
}

double ratioOf(const Timing& timing, const Timing& other) { return medianOf(quotients(timing.turns, other.turns)); }

std::vector<Timing> timeInTurns(std::span<const std::function<void()>> tasks, int repeats, double shortest) {
  for (const std::function<void()>& task : tasks) task();
  std::vector<std::vector<double>> seconds(tasks.size());
  for (int repeat = 0; repeat < repeats; ++repeat)
    for (std::size_t t = 0; t < tasks.size(); ++t) seconds[t].push_back(secondsOf(tasks[t], shortest));
  std::vector<Timing> timings;
  for (std::vector<double>& ofTask : seconds) timings.push_back(timingOf(std::move(ofTask)));
  return timings;
}

}  // namespace hemitex::reference
