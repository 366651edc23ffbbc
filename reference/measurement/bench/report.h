/// All measurements of `hemitex bench`, and ratios and crossovers of its runs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/measurement/bench/equal_time_error.h"
#include "reference/measurement/bench/exact_fallback_cost.h"
#include "reference/measurement/bench/render_times.h"
#include "reference/measurement/bench/solution_profile.h"
#include "reference/measurement/bench/thread_scaling.h"

namespace hemitex::reference {

/// Times of drawing and summing for growing numbers of elements.
struct BenchGrowth {
  std::string scene;
  int resolution = 0;
  std::vector<GrowthPoint> points;
};

/// The error of rows by hemicubes, and by rays from the same points in the same time (see distanceToTruth).
struct EqualTimeError {
  std::string scene;
  int resolution = 0;
  double seconds = 0;
  double hemicube = 0, rays = 0;
};

/// Members are empty if they were not measured.
struct BenchReport {
  std::vector<BenchRun> runs;
  std::optional<CoreGains> cores;
  std::vector<WallTimes> walls;
  std::vector<BenchGrowth> growth;
  std::vector<SolutionParts> parts;
  std::optional<SolutionMemory> memory;
  std::vector<EqualTimeError> errors;
};

/// One entry per resolution of hemicubes that are rotated per patch, as in solutions. Omits times outside the range of
/// the rays.
std::vector<EqualTimeError> equalTimeErrors(const std::string& scene, const RowComparison& comparison);

/// The time of a run over that of the hemicube with the same scene, number of triangles and resolution.
struct BenchRatio {
  std::string scene;
  std::size_t triangles = 0;
  int resolution = 0;
  std::string what;
  double overHemicube = 0;
};
/// The ratios of all runs except hemicubes, and except solutions, which choose their own patches. Of opengl and
/// opengl-plain only that of the faster.
std::vector<BenchRatio> benchRatios(const std::vector<BenchRun>& runs);

/// The number of triangles from which on Embree is faster. Interpolates linearly between the logarithms of triangles
/// and of ratios of times. The smallest measured number if Embree is always faster; nothing if it never is.
struct Crossover {
  std::string scene;
  int resolution = 0;
  std::optional<double> triangles;
};
std::vector<Crossover> crossovers(const std::vector<BenchRun>& runs);

}  // namespace hemitex::reference
