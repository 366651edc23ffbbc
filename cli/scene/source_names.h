/// Reads the source of form factors from the command line.
#pragma once

#include <string>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/rows/scene_rows.h"

namespace hemitex::cli {

/// Reads `SURFACE` or `SURFACE:COL,ROW`. Throws InputError if there is no such surface, or no such texel with area.
/// Also throws it for a texel of a name with several parts.
reference::Source sourceNamed(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const std::string& text);

}  // namespace hemitex::cli
