/// Scenes of one surface, and of a million.
#pragma once

#include <cstdint>

namespace hemitex::accuracy {

/// A lone square that emits 1: whatever it sends leaves the scene.
struct OneSurfaceFindings {
  double backgroundOfHemicube, backgroundOfRays;  ///< 1 exactly
  double lost;                                    ///< of what is emitted, by the solution: 1 exactly
};
OneSurfaceFindings ofOneSurface();

/// A floor under a ceiling that is cut into 1000 x 1000 surfaces (less one), each of one texel.
struct MillionFindings {
  std::uint32_t surfaces;
  double hemicubeError;    ///< what reaches the ceiling in all, against the closed form from the floor's centre
  double aliasing;         ///< what pixels along the ceiling's outline may make of it
  bool isWhole;            ///< whether the row sums to exactly 1, and no light falls through to a back
  double hemisphereError;  ///< of rays, against the closed form of the areas
  double standardError;
};
MillionFindings ofAMillionSurfaces();

}  // namespace hemitex::accuracy
