/// Scenes of one surface, and of a million.
#pragma once

#include <cstdint>

namespace hemitex::accuracy {

/// A single square that emits 1: all its light leaves the scene.
struct OneSurfaceFindings {
  double backgroundOfHemicube, backgroundOfRays;  ///< 1 exactly
  double lost;                                    ///< share of the emitted flux in the solution: exactly 1
};
OneSurfaceFindings ofOneSurface();

/// A floor below a ceiling that is divided into 1000 x 1000 surfaces (less one), each of one texel.
struct MillionFindings {
  std::uint32_t surfaces;
  double
      hemicubeError;  ///< of the form factor to the whole ceiling, relative to the closed form from the floor's centre
  double aliasing;    ///< bound of the error of pixels along the ceiling's outline
  bool isWhole;       ///< whether the row sums to exactly 1, and no light reaches a back
  double hemisphereError;  ///< of rays, relative to the closed form of the areas
  double standardError;
};
MillionFindings ofAMillionSurfaces();

}  // namespace hemitex::accuracy
