/// Progressive solutions with extreme reflectances and emissions, and their expected properties.
#pragma once

#include <vector>

namespace hemitex::accuracy {

/// A closed cube that emits 1 everywhere. For any form factors with closed rows, emitted = absorbed + unshot, and
/// absorbed = (1 - r) of the received flux. So the mean radiosity is (1 - r residual) / (1 - r).
struct FurnaceCase {
  double reflectance;
};

struct FurnaceFindings {
  int shots;
  double meanError;     ///< of the mean radiosity, relative
  double accountError;  ///< of absorbed + unshot + lost over emitted
  bool grew;            ///< whether any shot increased the unshot flux
};

std::vector<FurnaceCase> furnaces();
FurnaceFindings findingsOf(const FurnaceCase& furnace);

/// A closed cube with a light that hangs in it. Radiosity is linear in the emission.
struct EmissionCase {
  double emission;
  double share;  ///< the light's area over that of the scene
};

struct EmissionFindings {
  double
      linearityError;  ///< of the radiosity over the emission, relative to that for an emission of 1; the worst element
  double accountError;
};

std::vector<EmissionCase> emissions();
EmissionFindings findingsOf(const EmissionCase& emission);

}  // namespace hemitex::accuracy
