/// The scenes for measurements of speed, and their discretizations.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"

namespace hemitex::reference {

struct BenchScene {
  std::string name;  ///< of the file, without extension
  radiosity::Scene scene;
  radiosity::DiscretizationSettings elements;
  radiosity::IdSettings ids;
};

/// The elements of the room of the paper: `wall` along the side of a wall, `boxFace` along the side of a face of the
/// box, and `patch` along the side of a patch. The light is one element.
radiosity::DiscretizationSettings roomElements(int wall, int boxFace, int patch);

/// Packs a scene into eight pages of 64 x 64 texels, and divides each texel into subdivision x subdivision elements.
/// Patches have 4 x 4 undivided texels.
BenchScene packedScene(std::string name, radiosity::Scene scene, int subdivision);

/// Loads a scene with default settings. Throws InputError if nothing emits.
BenchScene benchScene(const std::filesystem::path& file);

/// Loads the room of the paper, the Cornell box and the gallery from the folder of the program's scenes. The gallery
/// replaces the complex scene of the paper. The room and the gallery are discretized as the fine level of the paper.
std::vector<BenchScene> benchScenes(const std::filesystem::path& folder);

}  // namespace hemitex::reference
