/// Times that can be compared: what is to be compared runs in turns, so that whatever else the machine does meets all
/// alike, and what counts is the median. What is short is called again and again in its turn, as a solution calls it:
/// its memory is in the caches, and its threads are awake.
#pragma once

#include <chrono>
#include <functional>
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
  double median = 0, least = 0;
  std::vector<double> turns;  ///< each, in their order
};

/// Of a part, where a call did so many.
Timing operator/(const Timing& timing, double parts);

/// Of times taken, one at least.
Timing timingOf(std::vector<double> turns);

/// Of values, one at least; between the two in the middle where their number is even.
double medianOf(std::vector<double> values);

/// What each turn gave over what it gave of something else; of as many.
std::vector<double> quotients(std::span<const double> turns, std::span<const double> others);

/// How many times longer one thing takes than another that ran in the same turns: the median of what each turn says. A
/// machine that is slower for a while is slower for both, whereas their medians may be of different whiles.
double ratioOf(const Timing& timing, const Timing& other);

/// Seconds that a turn takes at least.
inline constexpr double shortestTurn = 0.02;

/// Every task once without the clock, then all of them in their order, `repeats` times (at least 1). In its turn a task
/// is called until `shortest` seconds are over, at least once; the time is that of the mean call.
std::vector<Timing> timeInTurns(std::span<const std::function<void()>> tasks, int repeats,
                                double shortest = shortestTurn);

}  // namespace hemitex::reference
