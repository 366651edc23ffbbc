/// All that `hemitex bench` measures, and how it stands to what is asked of it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "reference/bench/element_scaling.h"
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

/// Something that is asked of the measurements, and whether they say so.
struct Requirement {
  std::string what;
  double measured = 0, limit = 0;
  bool isKept = false;
};

/// What was measured; what was not is empty.
struct BenchReport {
  std::vector<BenchRun> runs;
  std::optional<CoreGains> cores;
  std::vector<WallTimes> walls;
  std::vector<BenchGrowth> growth;
  std::vector<SolutionParts> parts;
  std::optional<SolutionMemory> memory;
  std::vector<EqualTimeError> errors;
  std::vector<Requirement> requirements;  ///< they speak of the program's own scenes
};

/// Of every resolution of turned hemicubes, which solutions use, that rays were measured around.
std::vector<EqualTimeError> equalTimeErrors(const std::string& scene, const RowComparison& comparison);

/// The number of triangles from which on Embree is faster, between the two that were measured around it: a straight
/// line in the logarithms of triangles and of the ratio of times. The fewest that were measured where Embree is always
/// faster; nothing where it never is.
struct Crossover {
  std::string scene;
  int resolution = 0;
  std::optional<double> triangles;
};
std::vector<Crossover> crossovers(const std::vector<BenchRun>& runs);

/// How many times longer one thing takes than another, at one scene, number of triangles and resolution.
struct BenchRatio {
  std::string scene;
  std::size_t triangles = 0;
  int resolution = 0;
  double ratio = 0;
};
/// Times of `what` over those of `of`, wherever both were run.
std::vector<BenchRatio> ratiosOf(const std::vector<BenchRun>& runs, const std::string& what, const std::string& of);

/// What was measured of the requirements, of each the worst of all that it speaks of.
std::vector<Requirement> requirementsOf(const BenchReport& report);

}  // namespace hemitex::reference
