#include "cli/common/renderers.h"
#include "raster/software/software_renderer.h"
#include "reference/opengl/opengl_renderer.h"

namespace hemitex::cli {

std::unique_ptr<raster::ItemBufferRenderer> makeRenderer(const raster::DrawList& list, Device device) {
  using reference::OpenGlPath;
  using reference::OpenGlRenderer;
  if (device == Device::OpenGl) return std::make_unique<OpenGlRenderer>(list, OpenGlPath::Shader);
  if (device == Device::OpenGlFixedFunction) return std::make_unique<OpenGlRenderer>(list, OpenGlPath::FixedFunction);
  return std::make_unique<raster::SoftwareRenderer>(list);
}

}  // namespace hemitex::cli
