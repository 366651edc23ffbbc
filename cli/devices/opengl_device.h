/// OpenGL renderers for commands that compare devices and also work without OpenGL.
#pragma once

#include <string>

#include "cli/common/console.h"
#include "radiosity/form_factors/scene_form_factors.h"

namespace hemitex::cli {

/// A function that makes OpenGL renderers. If there is no OpenGL device, prints `without` and the reason, and returns
/// an empty function.
radiosity::RendererFactory openGlRenderers(Console& console, const std::string& without);

}  // namespace hemitex::cli
