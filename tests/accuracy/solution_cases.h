/// Progressive solutions at the extremes of reflectance and emission, and what has to hold of them.
#pragma once

#include <vector>

namespace hemitex::accuracy {

/// A closed cube that emits 1 everywhere. Whatever the form factors, with every row closed, emitted = absorbed +
/// unshot, and absorbed = (1 - r) of all that arrived: the mean radiosity is (1 - r residual) / (1 - r).
struct FurnaceCase {
  double reflectance;
};

struct FurnaceFindings {
  int shots;
  double meanError;     ///< of the mean radiosity, relative
  double accountError;  ///< of absorbed + unshot + lost over emitted
  bool grew;            ///< whether a shot ever left more unshot than there was before it
};

std::vector<FurnaceCase> furnaces();
FurnaceFindings findingsOf(const FurnaceCase& furnace);

/// A closed cube with a light that hangs in it. Radiosity is linear in the emission.
struct EmissionCase {
  double emission;
  double share;  ///< the light's area over that of the scene
};

struct EmissionFindings {
  double linearityError;  ///< of the radiosity over the emission, against that of an emission of 1; the worst element
  double accountError;
};

std::vector<EmissionCase> emissions();
EmissionFindings findingsOf(const EmissionCase& emission);

}  // namespace hemitex::accuracy
