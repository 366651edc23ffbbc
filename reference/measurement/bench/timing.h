/// Measures the times of tasks for comparison. Tasks run in interleaved repetitions, so that other load on the machine
/// affects all of them equally. The result is the median of the repetitions.
#pragma once

#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "reference/base/stopwatch.h"

namespace hemitex::reference {

/// Seconds of one call.
struct Timing {
  double median = 0, min = 0;
  std::vector<double> repetitions;  ///< in the order in which they were measured
};

/// The time of one of `parts` equal parts of a call.
Timing operator/(const Timing& timing, double parts);

/// Median and minimum of `repetitions`, which must not be empty.
Timing timingOf(std::vector<double> repetitions);

/// The median of `values`, which must not be empty; for an even number, the mean of the two middle values.
double medianOf(std::vector<double> values);

/// The time of one task over that of another: the median of the ratios of each interleaved repetition; both need the
/// same number of repetitions. The ratio of medians could compare a slow phase of the machine with a fast one.
double ratioOf(const Timing& timing, const Timing& other);

/// Runs the tasks 0, 1, ..., `tasks` - 1 in this order, `repetitions` times (at least 1). `timed` runs a task in a
/// repetition and returns its seconds. A task that takes more than `longTime` seconds is not repeated.
std::vector<Timing> interleavedTimings(std::size_t tasks, int repetitions,
                                       const std::function<double(std::size_t task, int repetition)>& timed,
                                       double longTime = std::numeric_limits<double>::infinity());

/// Minimum duration of a repetition of a short task, in seconds.
inline constexpr double shortestRepetition = 0.02;

/// Measures short tasks as in a solution, with warm caches and running threads. Each task runs once before the
/// measurement. A repetition calls its task until `shortest` seconds are over, and has the mean time of a call. Before
/// that it calls task t for `warmUps[t]` seconds, if given: a graphics card that idled first runs at a lower clock.
std::vector<Timing> shortTaskTimings(std::span<const std::function<void()>> tasks, int repetitions,
                                     double shortest = shortestRepetition, std::span<const double> warmUps = {});

}  // namespace hemitex::reference
