/// What the second core brings: to pure arithmetic, which needs nothing else of the machine, and beside it to a
/// hemicube and to a whole solution. All in turns.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/bench/scenes.h"
#include "reference/bench/timing.h"

namespace hemitex::reference {

/// How many times faster a task is on two threads than on one, in each turn.
using GainByTurn = std::vector<double>;

/// Of a task that was timed on one and on two.
inline GainByTurn gainOf(const Timing& onOne, const Timing& onTwo) { return quotients(onOne.turns, onTwo.turns); }

/// That of each task: each runs on one thread and then on two, all in turns.
std::vector<GainByTurn> gainsOfSecondCore(std::span<const std::function<void()>> tasks, int repeats);

/// Medians of these gains, and of what they are of those of arithmetic in the same turn.
struct CoreGains {
  double arithmetic = 0, hemicube = 0, solution = 0;
  double hemicubeOfArithmetic = 0, solutionOfArithmetic = 0;
};

/// From the gains of each.
CoreGains coreGains(const GainByTurn& arithmetic, const GainByTurn& hemicube, const GainByTurn& solution);

/// `resolution` is that of both; the solution has `shots`. More than one thread must be allowed.
CoreGains coreGains(const BenchScene& scene, int resolution, int shots, int repeats);

}  // namespace hemitex::reference
