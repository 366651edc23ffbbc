/// Measures the time of a hemicube beside that of regular meshing, Embree, OpenGL and the baseline without geometry,
/// for the same pixels. All tasks run in interleaved repetitions (timing.h) on the same number of threads.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "radiosity/form_factors/scene_form_factors.h"
#include "reference/measurement/bench/scenes.h"
#include "reference/measurement/bench/timing.h"

namespace hemitex::reference {

struct BenchRun {
  std::string scene;
  std::size_t triangles = 0, elements = 0;
  int resolution = 0;
  int threads = 0;
  /// The measured task. All tasks use the same patches, except solutions, which choose their own:
  /// - hemicube: from a patch to its row of form factors: draws five faces, resolves item IDs and sums the row;
  /// - hemicube-mesh: the same with one polygon per element;
  /// - draw: draws faces and resolves item IDs;
  /// - embree: finds the nearest triangle of a ray through each of the same pixels (pixel_rays.h);
  /// - opengl-plain: draws the faces by plain OpenGL and reads them back, without the sum (OpenGlPath::Plain);
  /// - opengl: the same by the rules of docs/item-buffers.md (OpenGlPath::Shader). From 100,000 triangles on it
  ///   is slow, and is measured only at the highest resolution;
  /// - floor: clears buffers and sums the row of the first patch from item IDs drawn before (baseline.h);
  /// - solution: `benchShots` shots of the solver, or fewer if no light is left; shot: their mean.
  std::string what;
  Timing seconds;
};

/// Shots of a measured solution.
inline constexpr int benchShots = 10;

struct BenchSettings {
  std::vector<int> resolutions = {128, 256, 512, 1024};
  /// Scenes with fewer triangles are also measured with these numbers of triangles (subdivided_scene.h); ascending.
  std::vector<std::size_t> triangles = {8000, 100000, 1000000};
  int threads = 1;
  int repeats = 11;
  radiosity::RendererFactory openGl, plainOpenGl;  ///< by the rules, and plain; empty if there is no device
};

/// Measures the original and the subdivided scenes at every resolution. Meshing and solutions are measured for the
/// original scene only. `progress` is called with the name of each step.
std::vector<BenchRun> benchRuns(const BenchScene& scene, const BenchSettings& settings,
                                const std::function<void(const std::string&)>& progress);

/// Times of a hemicube in a scene with side x side elements per surface.
struct GrowthPoint {
  int side = 0;
  std::size_t elements = 0;
  Timing draw, row;  ///< draw: draws faces and resolves item IDs; row: sums the row
};

/// Measures one point per entry of `sides`, all in interleaved repetitions. Item IDs have 32 bits.
std::vector<GrowthPoint> growthOf(const radiosity::Scene& scene, std::span<const int> sides, int resolution,
                                  int repeats);

}  // namespace hemitex::reference
