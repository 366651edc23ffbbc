/// Radiosity textures with a channel per band.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/solver/progressive_solver.h"
#include "radiosity/textures/texture_layout.h"

namespace hemitex::radiosity {

/// The name of a band as a channel or a column: `b_` and its wavelength in nm, such as `b_450`.
std::string bandName(double wavelength);

/// Writes NAME.exr for each texture of the layout into a folder: the channels R, G and B hold the colour, and one
/// channel per band, named for its wavelength, holds its radiosity in W/m^2. The solution is that of a scene
/// with these wavelengths. See radiosityTextures. Throws InputError as writeExr.
void writeBandTextures(const std::filesystem::path& folder, const Discretization& discretization,
                       const TextureLayout& layout, const Solution& solution, const std::vector<double>& wavelengths);

}  // namespace hemitex::radiosity
