/// The file of `--bands`: wavelengths, and the spectra of materials.
///
///     {"wavelengths": [450, 550, 650],
///      "materials": {"white": {"reflectance": [0.7, 0.72, 0.75]},
///                    "lamp": {"reflectance": 0.8, "emission": [2, 8, 15]}}}
///
/// One number stands for all wavelengths, and the name of a `.rfl` file, relative to the folder of this one, for its
/// spectrum. The same as CSV, where `#` begins a comment:
///
///     material,quantity,450,550,650
///     white,reflectance,0.7,0.72,0.75
///     lamp,reflectance,0.8,0.8,0.8
///     lamp,emission,2,8,15
#pragma once

#include <filesystem>
#include <vector>

#include "radiosity/bands/spectral_scene.h"
#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"

namespace hemitex::cli {

struct BandsFile {
  radiosity::SpectralBands bands;
  std::vector<std::filesystem::path> files;  ///< that were read: this one and the spectra that it names
};

/// Reads a file, and the spectra of the scene's material files for what it does not name. Emissions are converted from
/// the unit of `settings` to radiosity. Throws InputError with the line for a file of wrong form, for wavelengths that
/// do not ascend, for a spectrum without a value for each, for a value below 0, a reflectance of 1 or more, an emission
/// above 1e30, and, with similar names, for a material that the scene does not have.
BandsFile readBands(const std::filesystem::path& file, const radiosity::Scene& scene,
                    const radiosity::SceneSettings& settings);

}  // namespace hemitex::cli
