/// The scene of a run with --bands, in colour and in each group of its bands.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "cli/scene/scene_options.h"
#include "radiosity/bands/spectral_scene.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// What differs between the bands of a scene.
struct BandLight {
  std::vector<radiosity::Material> materials;
  std::vector<radiosity::Image> images;
  glm::dmat3 ofColour{0.0};  ///< from the colour of light from outside, as lightIn
};

struct BandScenes {
  std::vector<double> wavelengths;      ///< nm, ascending
  radiosity::Scene inColour;            ///< with the files that were read
  std::vector<BandLight> groups;        ///< of groupsOfBands
  std::optional<BandLight> whole = {};  ///< of wholeSpectrum, if there are several groups
};

/// Loads the scene, reads its bands from `bandsFile`, and changes its materials as the options ask: a colour means the
/// bands that it stands for. Throws InputError as loadedScene and readBands, and if nothing emits in any band.
BandScenes bandScenes(const SceneOptions& options, const std::filesystem::path& bandsFile);

/// Gives a scene the materials and maps of a group.
void setLight(radiosity::Scene& scene, const BandLight& light);

}  // namespace hemitex::cli
