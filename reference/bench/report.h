/// All that `hemitex bench` measures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/bench/equal_time_error.h"
#include "reference/bench/exact_fallback_cost.h"
#include "reference/bench/render_times.h"
#include "reference/bench/solution_profile.h"
#include "reference/bench/thread_scaling.h"

namespace hemitex::reference {

/// Drawing and summing at rising numbers of elements.
struct BenchGrowth {
  std::string scene;
  int resolution = 0;
  std::vector<GrowthPoint> points;
};

/// A hemicube's row beside the row that rays find in the same time, from the same points: see distanceToTruth.
struct EqualTimeError {
  std::string scene;
  int resolution = 0;
  double seconds = 0;
  double hemicube = 0, rays = 0;
};

/// Empty where nothing was measured.
struct BenchReport {
  std::vector<BenchRun> runs;
  std::optional<CoreGains> cores;
  std::vector<WallTimes> walls;
  std::vector<BenchGrowth> growth;
  std::vector<SolutionParts> parts;
  std::optional<SolutionMemory> memory;
  std::vector<EqualTimeError> errors;
};

/// Of every resolution of turned hemicubes, which solutions use, that rays were measured around.
std::vector<EqualTimeError> equalTimeErrors(const std::string& scene, const RowComparison& comparison);

/// How many times as long a run takes as the hemicube of the same scene, number of triangles and resolution.
struct BenchRatio {
  std::string scene;
  std::size_t triangles = 0;
  int resolution = 0;
  std::string what;
  double overHemicube = 0;
};
/// Of all runs but hemicubes and solutions, which choose patches of their own.
std::vector<BenchRatio> benchRatios(const std::vector<BenchRun>& runs);

/// The number of triangles from which on Embree is faster, between the two that were measured around it: a straight
/// line in the logarithms of triangles and of the ratio of times. The fewest that were measured where Embree is always
/// faster; nothing where it never is.
struct Crossover {
  std::string scene;
  int resolution = 0;
  std::optional<double> triangles;
};
std::vector<Crossover> crossovers(const std::vector<BenchRun>& runs);

}  // namespace hemitex::reference
