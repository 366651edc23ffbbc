#include "radiosity/spectra/observer.h"

#include <array>
#include <cassert>

namespace hemitex::radiosity {
namespace {

struct Matching {
  double x, y, z;
};

/// The 1 nm table of ISO/CIE 11664-1, as the Colour and Vision Research Laboratory publishes it (cvrl.org, file
/// ciexyz31_1).
constexpr std::array<Matching, lastWavelength - firstWavelength + 1> observer{{
#include "radiosity/spectra/ciexyz31_1.inc"
}};

}  // namespace

glm::dvec3 observerAt(int wavelength) {
  assert(firstWavelength <= wavelength && wavelength <= lastWavelength);
  const Matching& row = observer[static_cast<std::size_t>(wavelength - firstWavelength)];
  return {row.x, row.y, row.z};
}

}  // namespace hemitex::radiosity
