/// The scenes that speed is measured on, and how they are discretized.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"

namespace hemitex::reference {

struct BenchScene {
  std::string name;  ///< of the file, without its ending
  radiosity::Scene scene;
  radiosity::DiscretizationSettings elements;
  radiosity::IdSettings ids;
};

/// By the program's defaults. Throws InputError where nothing emits.
BenchScene benchScene(const std::filesystem::path& file);

/// The paper's room, the Cornell box and the gallery, which stands for the paper's complex scene, from the folder of
/// the scenes that come with the program; the room and the gallery as finely as the paper's fine level.
std::vector<BenchScene> benchScenes(const std::filesystem::path& folder);

}  // namespace hemitex::reference
