/// How fast a hemicube is, beside whatever else gives the same pixels: regular meshing, Embree, OpenGL, and the floor
/// under it all. Everything is timed in interleaved repetitions (timing.h) on the same number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "radiosity/form_factors/scene_form_factors.h"
#include "reference/bench/scenes.h"
#include "reference/bench/timing.h"

namespace hemitex::reference {

struct BenchRun {
  std::string scene;
  std::size_t triangles = 0, elements = 0;
  int resolution = 0;
  int threads = 0;
  /// What took the time, of the same patches but for solutions, which choose theirs:
  /// - hemicube: from a patch to its row of form factors; five faces drawn, item IDs resolved, the row summed;
  /// - hemicube-mesh: the same where elements are polygons;
  /// - draw: faces drawn and item IDs resolved alone;
  /// - embree: rays through the same pixels, which triangle each meets (pixel_rays.h);
  /// - opengl: the faces drawn and read back, without the sum; from 100,000 triangles on, where it takes long, at the
  ///   highest resolution alone;
  /// - floor: buffers cleared and the row summed of item IDs drawn before, of the first patch (baseline.h);
  /// - solution: so many shots by the solver, `benchShots`, or fewer where no light is left; shot: the mean one.
  std::string what;
  Timing seconds;
};

/// Of a solution.
inline constexpr int benchShots = 10;

struct BenchSettings {
  std::vector<int> resolutions = {128, 256, 512, 1024};
  /// Scenes of fewer triangles are also cut into so many (subdivided_scene.h), ascending.
  std::vector<std::size_t> triangles = {8000, 100000, 1000000};
  int threads = 1;
  int repeats = 11;
  radiosity::RendererFactory openGl;  ///< empty where there is no device
};

/// Of a scene as it is and cut, everything at every resolution; meshing and solutions of the scene as it is alone.
std::vector<BenchRun> benchRuns(const BenchScene& scene, const BenchSettings& settings,
                                const std::function<void(const std::string&)>& progress);

/// A hemicube of a scene whose surfaces have side x side elements each.
struct GrowthPoint {
  int side = 0;
  std::size_t elements = 0;
  Timing draw, row;  ///< faces drawn and item IDs resolved; their row summed
};

/// One point per entry of `sides`, all in interleaved repetitions. Item IDs have 32 bits.
std::vector<GrowthPoint> growthOf(const radiosity::Scene& scene, std::span<const int> sides, int resolution,
                                  int repeats);

}  // namespace hemitex::reference
