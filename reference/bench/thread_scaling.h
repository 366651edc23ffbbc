/// How much faster a second core makes pure arithmetic, which needs nothing else of the machine, a hemicube and a whole
/// solution.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/bench/scenes.h"

namespace hemitex::reference {

/// How many times faster each task is on two threads than on one, in each repetition. All runs are interleaved.
std::vector<std::vector<double>> gainsOfSecondCore(std::span<const std::function<void()>> tasks, int repeats);

/// Medians of these gains, and of their ratios to the gains of arithmetic in the same repetition.
struct CoreGains {
  double arithmetic = 0, hemicube = 0, solution = 0;
  double hemicubeOfArithmetic = 0, solutionOfArithmetic = 0;
};

/// From the gains of each repetition.
CoreGains coreGains(const std::vector<double>& arithmetic, const std::vector<double>& hemicube,
                    const std::vector<double>& solution);

/// `resolution` is that of both; the solution has `shots`. More than one thread must be allowed.
CoreGains coreGains(const BenchScene& scene, int resolution, int shots, int repeats);

}  // namespace hemitex::reference
