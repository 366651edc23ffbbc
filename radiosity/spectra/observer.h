/// The CIE 1931 2-degree standard observer.
#pragma once

#include <glm/glm.hpp>

namespace hemitex::radiosity {

/// The wavelengths of the table, in steps of 1 nm.
inline constexpr int firstWavelength = 360, lastWavelength = 830;

/// The colour matching functions x, y and z at a whole number of nm from firstWavelength to lastWavelength.
glm::dvec3 observerAt(int wavelength);

}  // namespace hemitex::radiosity
