#include "cli/devices/row_device.h"

#include "raster/base/input_error.h"
#include "raster/interface/item_id.h"

namespace hemitex::cli {

void addRowDevice(Command command, RowDevice& device) {
  command = command.under("Form factors");
  const Option option = addChoice<Device>(
      command, "--device", device.device, reference::rowDevices(),
      "draw rows with this renderer. A device is judged first, and refused if it draws test vectors with errors "
      "(default software)");
  command.addText("--device-name", "NAME", "draw with the first device whose name contains this", device.name)
      .needs(option);
}

RendererMaker rowRenderers(const RowDevice& device, Console& console) {
  return judgedRenderers(device, "/proc/self/exe", [&console](const std::string& text) { console.message(text); });
}

/// Tests the device with an empty draw list, because an OpenGL context is made only for a renderer.
RendererMaker openGlRenderers(Device device, Console& console, const std::string& without) {
  const auto make = [device](const raster::DrawList& list) { return makeRenderer(list, device); };
  try {
    raster::DrawList empty;
    empty.format = *raster::formatNamed("r8g8b8a8");
    make(empty);
    console.message("OpenGL draws with " + deviceName(device));
    return make;
  } catch (const raster::InputError& error) {
    console.message(without + ": " + error.what());
    return {};
  }
}

}  // namespace hemitex::cli
