/// Scenes whose materials have spectra. The solver has three bands; so the bands of a scene are solved in groups of
/// three, each as a scene whose R, G and B are these bands.
///
/// Where a material, a map or light from outside has only a colour, its R stands for wavelengths from 590 nm, G for
/// those from 490 nm, and B for shorter ones. So a grey reflectance has its value at all wavelengths. Light is divided
/// by the colour of equal energy, so that it keeps its colour. Of a saturated colour, the channels of the spectrum (see
/// colour.h) differ from those of the colour by at most 0.08 of its largest one.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
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

/// The bands, as numbers of wavelengths, that stand in the place of R, G and B. An empty place is dark.
using BandGroup = std::array<std::vector<std::size_t>, 3>;

/// Groups of one band per place: from the longest wavelength to the shortest, as R, G and B are.
std::vector<BandGroup> groupsOfBands(std::size_t bands);
/// Where the band of a number is in these groups.
struct BandPlace {
  std::size_t group = 0;
  int place = 0;
};
BandPlace placeOf(std::size_t band, std::size_t bands);

/// All bands, in the places of the colours that stand for them: a coarse view of the whole spectrum.
BandGroup wholeSpectrum(std::span<const double> wavelengths);

/// The matrix from the colour of light to its values in a group: in each place the sum over its bands.
glm::dmat3 lightIn(const BandGroup& group, std::span<const double> wavelengths);
/// The reflectance of a colour in a group: in each place the mean over its bands.
glm::dvec3 reflectanceIn(const BandGroup& group, std::span<const double> wavelengths, const glm::dvec3& colour);

/// The scene in a group: with its materials, maps and light from outside in these bands.
Scene inGroup(Scene scene, const SpectralBands& bands, const BandGroup& group);

/// The scene as it looks: with colours for the spectra of materials. Negative channels are 0, and a reflectance is
/// below 1.
Scene inColour(Scene scene, const SpectralBands& bands, double maxReflectance);

}  // namespace hemitex::radiosity
