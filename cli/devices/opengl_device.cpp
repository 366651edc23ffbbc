#include "cli/devices/opengl_device.h"

#include "raster/base/input_error.h"

namespace hemitex::cli {

/// Tests the device with an empty draw list, because an OpenGL context is made only for a renderer.
radiosity::RendererFactory openGlRenderers(Device device, Console& console, const std::string& without) {
  const auto make = [device](const raster::DrawList& list) { return makeRenderer(list, device); };
  try {
    raster::DrawList empty;
    empty.format = *raster::formatNamed("r8g8b8a8");
    make(empty);
    return make;
  } catch (const raster::InputError& error) {
    console.message(without + ": " + error.what());
    return {};
  }
}

}  // namespace hemitex::cli
