#include "reference/timing.h"

#include <algorithm>
#include <cassert>

#include "reference/stopwatch.h"

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

Timing timingOf(std::vector<double> seconds) {
  assert(!seconds.empty());
  std::sort(seconds.begin(), seconds.end());
  const std::size_t half = seconds.size() / 2;
  const double median = seconds.size() % 2 == 1 ? seconds[half] : (seconds[half - 1] + seconds[half]) / 2;
  return {median, seconds.front(), static_cast<int>(seconds.size())};
}

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
