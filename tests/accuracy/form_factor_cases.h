/// Form factors at the extremes that are known exactly, and what each part of hemitex gives for them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "radiosity/scene/scene.h"
#include "reference/rays/sample_points.h"

namespace hemitex::accuracy {

/// The side of every hemicube of the page, in pixels, and the rays (or points, where they are aimed) of every row.
inline constexpr int hemicubeResolution = 256;
inline constexpr int raySamples = 1 << 13;

/// The light that goes from the first surface of a scene to another, mostly the second.
struct FormFactorCase {
  std::string name;
  std::string truth;  ///< where the exact value comes from
  std::vector<radiosity::Surface> surfaces;
  double exact;
  bool isBlocked = false;  ///< something else is in the way, which closed forms do not look at
  std::uint32_t to = 1;    ///< the receiver
  /// How far corners written in binary64 move the exact value, relative.
  double inputRounding = 0;
  /// How much light leaves from a rim so narrow that no point of the rays' may fall there.
  double rim = 0;
};

/// Hemicubes that stand on the first surface, and closed forms from the same points.
struct FromCentres {
  double hemicubes;   ///< their mean
  double closedForm;  ///< from where their eyes stand, nothing in the way
  double aliasing;    ///< how far the pixels along the outline can set the two apart
  double lost;        ///< left the scene, or absorbed by backs
};

struct FormFactorAnswers {
  double closedForm;
  reference::Measurement aimed, hemisphere;
  double lostByRays;      ///< by those over the hemisphere
  FromCentres one, many;  ///< a single centre, and 8 x 8
};

FormFactorAnswers answersTo(const FormFactorCase& extreme);

/// Off the exact value, relative to it; where it is 0, in parts of all light.
double errorOf(double value, const FormFactorCase& extreme);

struct FormFactorTheme {
  std::string title;
  std::string text;  ///< what the page says above the table
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
