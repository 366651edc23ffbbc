#include "cli/devices/renderers.h"
#include "reference/devices/opengl/opengl_renderer.h"

namespace hemitex::cli {
namespace {

reference::OpenGlPath pathOf(Device device) {
  if (device == Device::OpenGlFixedFunction) return reference::OpenGlPath::FixedFunction;
  if (device == Device::OpenGlPlain) return reference::OpenGlPath::Plain;
  return reference::OpenGlPath::Shader;
}

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name) {
  return reference::makeOpenGlRenderer(list, pathOf(device), name);
}

std::string openGlDeviceName(const std::string& name) { return reference::openGlDeviceName(name); }

}  // namespace hemitex::cli
