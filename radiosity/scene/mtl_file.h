/// Parses the parts of an MTL file that radiosity uses: the diffuse reflectance and the emission of materials. Numbers
/// are read and checked here; tinyobjloader parses the options of maps.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene_settings.h"
#include "radiosity/spectra/spectrum.h"

namespace hemitex::radiosity {

/// W/m^2 of radiosity. With larger values, interreflection could overflow binary32, which images use.
inline constexpr double largestEmission = 1e30;

/// A `map_Kd`, `map_Ke` or `map_d` line.
struct MapStatement {
  std::string image;         ///< as the file names it (see named_file.h); empty if the line names none
  Sampler sampler = {};      ///< of `-s`, `-o` and `-clamp`
  std::string omitted = {};  ///< its other options, such as `-mm`, with blanks between them
};

/// A line such as `Kd spectral FILE.rfl FACTOR`.
struct SpectrumStatement {
  std::filesystem::path spectrum;  ///< relative to the folder of the material file
  double factor = 1;               ///< of all values, finite and not negative
  int line = 0;                    ///< counted from 1
};

/// A material, with the values that the file states.
struct MaterialStatement {
  std::string name;
  std::optional<glm::dvec3> reflectance = {};                 ///< Kd, finite and not negative
  std::optional<glm::dvec3> emission = {};                    ///< Ke as written; as radiosity 0 to largestEmission
  std::optional<SpectrumStatement> reflectanceSpectrum = {};  ///< Kd, if its last line names a spectrum
  std::optional<SpectrumStatement> emissionSpectrum = {};     ///< Ke, if its last line names a spectrum
  std::optional<MapStatement> reflectanceMap = {};
  std::optional<MapStatement> emissionMap = {};
  std::optional<double> dissolve = {}, transparency = {};  ///< `d` and `Tr`
  std::optional<MapStatement> dissolveMap = {};            ///< `map_d`
  bool hasDecal = false;                                   ///< `decal`
};

/// Parses the text of `file`; returns the materials in its order. Keywords may be in any letters. Throws InputError
/// with the line for a Kd or Ke that is malformed, non-finite, negative, or has neither one number (grey) nor three.
/// Also throws it for a Ke above 1e30 after conversion from `unit` to radiosity.
std::vector<MaterialStatement> parseMaterials(std::string_view text, const std::filesystem::path& file,
                                              EmissionUnit unit = EmissionUnit::Radiosity);

/// The spectrum of a statement in a material file, times its factor. Throws InputError with the line of the statement
/// if the file of the spectrum cannot be read, and as parseSpectrum.
Spectrum readSpectrum(const SpectrumStatement& statement, const std::filesystem::path& materialFile);

}  // namespace hemitex::radiosity
