/// Measures the runs of Tables 1 and 2 of Nielsen and Christensen (2002) again. Each scene is solved at three levels of
/// discretization, by textures and by regular meshing, on every device and at two hemicube resolutions. A run has the
/// times of the parts of a solution.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// A scene at one level of discretization.
struct PaperLevel {
  std::string name;  ///< coarse, medium or fine
  radiosity::Discretization discretization;
  radiosity::IdLayout layout;
};

struct PaperScene {
  std::string name;
  radiosity::Scene scene;
  std::vector<PaperLevel> levels;
  int shots = 100;  ///< at least 1
};

/// A device that draws item buffers.
struct PaperDevice {
  std::string name;  ///< software, or that of a hardware device
  radiosity::RendererFactory makeRenderer;
  /// Maximum number of elements that all shots by meshing draw together; at least one shot is made. More would take too
  /// long.
  std::size_t maxMeshElements = 5000000;
};

/// Seconds of a solution. `total` does not include loading and discretizing. `formFactors` is the part from patches to
/// rows. `draw` is the part of it that draws and resolves item buffers.
struct PaperTimes {
  double total = 0, formFactors = 0, draw = 0;
};

struct PaperRun {
  std::string scene;
  std::size_t triangles = 0;
  std::string device, discretize, level;  ///< `discretize` is texture or mesh
  int resolution = 0;
  std::size_t elements = 0;
  int shots = 0;
  PaperTimes seconds;
};

struct PaperSettings {
  std::vector<int> resolutions = {128, 512};
  int repeats = 3;      ///< at least 1
  double longTime = 5;  ///< seconds; a longer run is not repeated
};

/// Measures every scene, device, method, level and resolution, in this order, in interleaved repetitions (timing.h).
/// Every repetition shoots the same patches, so times are sums of the medians of each shot and of the rest. One row is
/// drawn before the measurement.
std::vector<PaperRun> measurePaperRuns(const std::vector<PaperScene>& scenes, const std::vector<PaperDevice>& devices,
                                       const PaperSettings& settings,
                                       const std::function<void(double fraction, const std::string& what)>& progress);

/// Seconds of a solution: one entry per shot, and the rest of the total.
struct ShotTimes {
  std::vector<double> formFactors, draw;
  double rest = 0;
};

/// Sums of the medians of each shot. All repetitions must have the same number of shots.
PaperTimes mediansOf(const std::vector<ShotTimes>& repeats);

}  // namespace hemitex::reference
