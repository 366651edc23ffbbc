/// Scenes in bands of wavelengths, whose materials have spectra.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "radiosity/scene/scene_settings.h"
#include "radiosity/spectra/spectrum.h"

namespace hemitex::radiosity {

/// What a material has instead of the reflectance and the emission of Material.
struct MaterialSpectra {
  std::optional<Spectrum> reflectance = {};  ///< in [0, 1)
  std::optional<Spectrum> emission = {};     ///< emitted radiosity at each wavelength, from 0 to 1e30
};

struct SpectralBands {
  std::vector<double> wavelengths;                   ///< nm, ascending; at least one
  std::map<std::string, MaterialSpectra> materials;  ///< by name; others have their colours
};

/// The spectra that the material files of a scene state, by the names of its materials. Emissions become radiosity, and
/// reflectances of 1 or more are lowered, as `settings` say. Throws InputError as readSpectrum.
std::map<std::string, MaterialSpectra> spectraOfFiles(const Scene& scene, const SceneSettings& settings);

/// Throws InputError if wavelengths do not ascend from above 0, if the scene has no material of a name, or for a
/// reflectance or an emission out of range. Messages name neither files nor lines.
void requireValid(const SpectralBands& bands, const Scene& scene);

/// The scene in bands. Materials with spectra get their colours, for pictures: negative channels are 0, and a
/// reflectance is at most `maxReflectance`. Warns of materials of surfaces that have only colours.
Scene inBands(Scene scene, const SpectralBands& bands, double maxReflectance);

}  // namespace hemitex::radiosity
