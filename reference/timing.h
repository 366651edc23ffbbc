/// Times that can be compared: what is to be compared runs in turns, so that whatever else the machine does meets all
/// alike, and what counts is the median. What is short is called again and again in its turn, as a solution calls it:
/// its memory is in the caches, and its threads are awake.
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace hemitex::reference {

/// Seconds of one call.
struct Timing {
  double median = 0, least = 0;
  int repeats = 0;
};

/// Of a part, where a call did so many.
inline Timing operator/(const Timing& timing, double parts) {
  return {timing.median / parts, timing.least / parts, timing.repeats};
}

/// Of times taken, one at least.
Timing timingOf(std::vector<double> seconds);

/// Seconds that a turn takes at least.
inline constexpr double shortestTurn = 0.02;

/// Every task once without the clock, then all of them in their order, `repeats` times (at least 1). In its turn a task
/// is called until `shortest` seconds are over, at least once; the time is that of the mean call.
std::vector<Timing> timeInTurns(std::span<const std::function<void()>> tasks, int repeats,
                                double shortest = shortestTurn);

}  // namespace hemitex::reference
