/// Times that can be compared. Tasks run in interleaved repetitions, so that a disturbance of the machine hits all of
/// them alike, and the median of the repetitions counts.
#pragma once

#include <chrono>
#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace hemitex::reference {

/// Seconds since it was made.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Seconds of one call.
struct Timing {
  double median = 0, min = 0;
  std::vector<double> repetitions;  ///< in the order in which they were measured
};

/// The time of one part of a call that has so many equal parts.
Timing operator/(const Timing& timing, double parts);

/// `repetitions` has at least one entry.
Timing timingOf(std::vector<double> repetitions);

/// `values` has at least one entry. The mean of the two middle values where their number is even.
double medianOf(std::vector<double> values);

/// values[i] / others[i]; both have the same size.
std::vector<double> quotients(std::span<const double> values, std::span<const double> others);

/// How many times as long one task takes as another of the same interleaved repetitions: the median of the ratios of
/// each repetition. The ratio of the medians could compare a slow phase of the machine with a fast one.
double ratioOf(const Timing& timing, const Timing& other);

/// Runs the tasks 0, 1, ..., `tasks` - 1 and then all of them again, `repetitions` times (at least 1). `timed` runs a
/// task in a repetition and returns its seconds. A task that takes more than `longTime` seconds is not repeated.
std::vector<Timing> interleavedTimings(std::size_t tasks, int repetitions,
                                       const std::function<double(std::size_t task, int repetition)>& timed,
                                       double longTime = std::numeric_limits<double>::infinity());

/// Minimum duration of a repetition of a short task, in seconds.
inline constexpr double shortestRepetition = 0.02;

/// The same for short tasks, as a solution calls them: with warm caches and threads that are awake. Each task runs once
/// before the measurement. A repetition calls its task until `shortest` seconds are over, and has the mean time.
std::vector<Timing> shortTaskTimings(std::span<const std::function<void()>> tasks, int repetitions,
                                     double shortest = shortestRepetition);

}  // namespace hemitex::reference
