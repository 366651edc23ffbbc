/// Reads the sources of form factors from the command line.
#pragma once

#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/rows/scene_rows.h"

namespace hemitex::cli {

/// Reads `SURFACE` or `SURFACE:COL,ROW`. Throws InputError if there is no such surface, or no such texel with area.
/// Also throws it for a texel of a name with several parts.
reference::Source sourceNamed(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const std::string& text);

/// A point with a unit normal, which the text names.
struct NamedPoint {
  std::string name;
  radiosity::SurfacePoint point;
};
/// Reads `x,y,z,nx,ny,nz`, or the name of a CSV file with one such line per point, perhaps below a heading. Throws
/// InputError for other text, and for a normal of length 0.
std::vector<NamedPoint> pointsNamed(const std::string& text);

}  // namespace hemitex::cli
