#include "reference/measurement/bench/timing.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace hemitex::reference {
namespace {

/// Mean seconds of a call, over as many calls as take `shortest` seconds.
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

Timing timingOf(std::vector<double> repetitions) {
  const double median = medianOf(repetitions), min = *std::min_element(repetitions.begin(), repetitions.end());
  return {median, min, std::move(repetitions)};
}

Timing operator/(const Timing& timing, double parts) {
  Timing part{timing.median / parts, timing.min / parts, timing.repetitions};
  for (double& seconds : part.repetitions) seconds /= parts;
  return part;
}

double ratioOf(const Timing& timing, const Timing& other) {
  assert(timing.repetitions.size() == other.repetitions.size());
  std::vector<double> ratios(timing.repetitions.size());
  std::transform(timing.repetitions.begin(), timing.repetitions.end(), other.repetitions.begin(), ratios.begin(),
                 std::divides());
  return medianOf(std::move(ratios));
}

std::vector<Timing> interleavedTimings(std::size_t tasks, int repetitions,
                                       const std::function<double(std::size_t, int)>& timed, double longTime) {
  std::vector<std::vector<double>> seconds(tasks);
  for (int repetition = 0; repetition < repetitions; ++repetition)
    for (std::size_t task = 0; task < tasks; ++task)
      if (repetition == 0 || seconds[task].front() <= longTime) seconds[task].push_back(timed(task, repetition));
  std::vector<Timing> timings;
  for (std::vector<double>& ofTask : seconds) timings.push_back(timingOf(std::move(ofTask)));
  return timings;
}

std::vector<Timing> shortTaskTimings(std::span<const std::function<void()>> tasks, int repetitions, double shortest,
                                     std::span<const double> warmUps) {
  for (const std::function<void()>& task : tasks) task();
  return interleavedTimings(tasks.size(), repetitions, [&](std::size_t task, int) {
    if (!warmUps.empty() && warmUps[task] > 0) secondsOf(tasks[task], warmUps[task]);
    return secondsOf(tasks[task], shortest);
  });
}

}  // namespace hemitex::reference
