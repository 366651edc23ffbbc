/// OpenGL as one of several devices: commands that compare devices do without it where it is not there.
#pragma once

#include <string>

#include "cli/common/console.h"
#include "radiosity/form_factors/scene_form_factors.h"

namespace hemitex::cli {

/// Makes OpenGL renderers. Empty where there is no device; a message then says why, behind what there will not be.
radiosity::RendererFactory openGlRenderers(Console& console, const std::string& without);

}  // namespace hemitex::cli
