/// OpenGL renderers for commands that compare devices and also work without OpenGL.
#pragma once

#include <string>

#include "cli/common/console.h"
#include "cli/devices/renderers.h"
#include "radiosity/form_factors/scene_form_factors.h"

namespace hemitex::cli {

/// A function that makes renderers for one of the devices of OpenGL. If there is none, prints `without` and the reason,
/// and returns an empty function.
radiosity::RendererFactory openGlRenderers(Device device, Console& console, const std::string& without);

}  // namespace hemitex::cli
