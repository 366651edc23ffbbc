/// Times that can be compared: what is to be compared runs in turns, so that whatever else the machine does meets all
/// alike, and what counts is the median.
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

/// Every task once without the clock, then all of them in their order, `repeats` times (at least 1).
std::vector<Timing> timeInTurns(std::span<const std::function<void()>> tasks, int repeats);

}  // namespace hemitex::reference
