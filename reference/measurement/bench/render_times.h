/// Measures the time of a hemicube beside that of regular meshing, Embree, OpenGL and the baseline without geometry,
/// for the same pixels. All tasks run in interleaved repetitions (timing.h) on the same number of threads.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
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
  /// - opengl: the same by the rules of docs/item-buffers.md (OpenGlPath::Shader);
  /// - floor: the lower bound without geometry: clears buffers and sums the row of the first patch from item IDs that
  ///   were drawn before, by runs of equal IDs, with one comparison per pixel;
  /// - solution: `benchShots` shots of the solver, or fewer if no light is left; shot: their mean.
  std::string what;
  Timing seconds;
};

/// Shots of a measured solution.
inline constexpr int benchShots = 10;

struct BenchSettings {
  std::vector<int> resolutions = {128, 256, 512, 1024};
  int threads = 1;
  int repeats = 11;
  std::vector<std::pair<std::string, radiosity::RendererFactory>> devices;  ///< besides software, with their `what`
};

/// Measures a scene at every resolution. `progress` is called with the name of each step.
std::vector<BenchRun> benchRuns(const BenchScene& scene, const BenchSettings& settings,
                                const std::function<void(const std::string&)>& progress);

/// The time of a run over that of the hemicube with the same scene, number of triangles and resolution. Nothing for
/// hemicubes, for shots and solutions, which choose their own patches, and for the slower of opengl and opengl-plain.
std::optional<double> overHemicube(const BenchRun& run, const std::vector<BenchRun>& runs);

}  // namespace hemitex::reference
