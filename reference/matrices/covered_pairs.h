/// Pairs of surfaces that a program may see through: one lies right behind the other, or in the same place.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// `behind` lies behind `front`, or in the same place, and should not be visible through it.
struct CoveredPair {
  std::uint32_t front = 0, behind = 0;
  bool isOnePlace = false;    ///< both face the same way and are in contact: either of them may receive the light
  bool isBackToBack = false;  ///< both face away from each other and are in contact
};

/// The pairs of parallel surfaces one over the other, at a distance of at most a hundredth of the smaller one's size.
std::vector<CoveredPair> coveredPairs(const radiosity::Scene& scene);

/// The centroid of a surface.
glm::dvec3 middleOf(const radiosity::Surface& surface);

}  // namespace hemitex::reference
