/// Radiosity textures with a channel per band.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/bands/colour_solution.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::radiosity {

/// The name of a band as a channel or a column: `b_` and its wavelength in nm, such as `b_450`.
std::string bandName(double wavelength);

/// Writes NAME.exr for each texture of the layout into a folder: the channels R, G and B hold `colours`, one per
/// element, and one channel per band holds its radiosity in W/m^2. See radiosityTextures. Throws InputError as
/// writeExr.
void writeBandTextures(const std::filesystem::path& folder, const Discretization& discretization,
                       const TextureLayout& layout, const BandSolution& bands, const std::vector<glm::dvec3>& colours);

}  // namespace hemitex::radiosity
