#include "reference/devices/choice/renderers.h"
#include "reference/devices/opengl/opengl_renderer.h"

namespace hemitex::reference {
namespace {

OpenGlPath pathOf(Device device) {
  if (device == Device::OpenGlFixedFunction) return OpenGlPath::FixedFunction;
  if (device == Device::OpenGlPlain) return OpenGlPath::Plain;
  return OpenGlPath::Shader;
}

}  // namespace

std::unique_ptr<raster::ItemBufferRenderer> makeOpenGlRenderer(const raster::DrawList& list, Device device,
                                                               const std::string& name) {
  return makeOpenGlRenderer(list, pathOf(device), name);
}

}  // namespace hemitex::reference
