/// The runs behind Tables 1 and 2 of Nielsen and Christensen (2002), made again: a scene solved at three levels of
/// discretization by textures and by regular meshing, on every device, at two hemicube resolutions, and what each part
/// of the solution takes.
#pragma once

#include <cstdint>
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

/// Something that draws item buffers.
struct PaperDevice {
  std::string name;  ///< software or opengl
  radiosity::RendererFactory makeRenderer;
  /// No more shots by meshing than draw so many elements in all, but one: where there are many, it takes too long.
  std::size_t maxMeshElements = 5000000;
};

/// Seconds of a solution: all of it without loading and discretizing; of that, form factors, from a patch to its row;
/// and of that, drawing and resolving item buffers.
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
  double longTime = 5;  ///< a run that takes more seconds is not repeated
};

/// Every scene, device, method, level and resolution, in this order, in interleaved repetitions (timing.h). Times are
/// medians: of each shot, since every repetition shoots the same patches, and of what is left of the total. One row is
/// drawn before the measurement.
std::vector<PaperRun> measurePaperRuns(const std::vector<PaperScene>& scenes, const std::vector<PaperDevice>& devices,
                                       const PaperSettings& settings,
                                       const std::function<void(double fraction, const std::string& what)>& progress);

/// The times of a solution, one entry a shot, and what is left of its total.
struct ShotTimes {
  std::vector<double> formFactors, draw;
  double rest = 0;
};

/// The sums of the shots' medians; all have equally many shots.
PaperTimes mediansOf(const std::vector<ShotTimes>& repeats);

}  // namespace hemitex::reference
