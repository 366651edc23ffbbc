/// Measures the speed-up from one to two threads, for a hemicube, for a solution, and for pure arithmetic, which is the
/// reference without memory access.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/measurement/bench/scenes.h"

namespace hemitex::reference {

/// The speed-up of each task in each repetition: time on one thread over time on two. All runs are interleaved.
std::vector<std::vector<double>> gainsOfSecondCore(std::span<const std::function<void()>> tasks, int repeats);

/// Medians of speed-ups, and of their ratios to the speed-up of arithmetic in the same repetition.
struct CoreGains {
  double arithmetic = 0, hemicube = 0, solution = 0;
  double hemicubeOfArithmetic = 0, solutionOfArithmetic = 0;
};

/// Computes the medians from the speed-ups of each repetition.
CoreGains coreGains(const std::vector<double>& arithmetic, const std::vector<double>& hemicube,
                    const std::vector<double>& solution);

/// Measures hemicubes of a scene and a solution of `shots` shots, both at `resolution`. More than one thread must be
/// permitted.
CoreGains coreGains(const BenchScene& scene, int resolution, int shots, int repeats);

}  // namespace hemitex::reference
