/// Extreme scenes with exactly known form factors, and the results of all methods of hemitex for them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "reference/truth/rays/sample_points.h"

namespace hemitex::accuracy {

/// The side of each hemicube of the page, in pixels, and the number of rays (or points, if aimed) per row.
inline constexpr int hemicubeResolution = 256;
inline constexpr int raySamples = 1 << 13;

/// The form factor from the first surface of a scene to another, usually the second.
struct FormFactorCase {
  std::string name;
  std::string truth;  ///< source of the exact value
  std::vector<radiosity::Surface> surfaces;
  double exact;
  bool isBlocked = false;  ///< there is a blocker, which closed forms ignore
  std::uint32_t to = 1;    ///< number of the receiver
  /// Relative change of the exact value by the rounding of corners to double precision.
  double inputRounding = 0;
  /// The share of light that leaves through a rim so narrow that no sample may fall there.
  double rim = 0;
};

/// Hemicubes over the first surface, and closed forms from the same points.
struct FromCentres {
  double hemicubes;   ///< their mean
  double closedForm;  ///< from the eyes of the hemicubes, without blockers
  double aliasing;    ///< bound of the difference caused by pixels along the outline
  double lost;        ///< left the scene, or absorbed by backs
};

struct FormFactorAnswers {
  double closedForm;
  reference::Measurement aimed, hemisphere;
  double lostByRays;      ///< by rays over the hemisphere
  FromCentres one, many;  ///< a single centre, and 8 x 8
};

FormFactorAnswers answersTo(const FormFactorCase& extreme);

/// The error relative to the exact value; if that is 0, as a share of all light.
double errorOf(double value, const FormFactorCase& extreme);

struct FormFactorTheme {
  std::string title;
  std::string text;  ///< the text of the page above the table
  std::vector<FormFactorCase> cases;
};

FormFactorTheme gaps();
FormFactorTheme slivers();
FormFactorTheme touching();
FormFactorTheme angles();
FormFactorTheme blockers();
FormFactorTheme coincident();
FormFactorTheme scaledAndMoved();
FormFactorTheme smallEmitters();

}  // namespace hemitex::accuracy
