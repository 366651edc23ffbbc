/// The pipeline for hardware with shaders (item_ids.vert), which implement all rules of docs/item-buffers.md.
///
/// An item ID is a 32-bit integer in buffers and in the framebuffer, so that item IDs may have any format. The draw
/// list is uploaded once for all views (shader_inputs.h). In a scene the depth is w, unless it is stored; smaller is
/// nearer.
#include "raster/base/input_error.h"
#include "reference/devices/opengl/context.h"
#include "reference/devices/opengl/pipeline.h"
#include "reference/devices/shader_inputs.h"

// CMake puts the texts of the shaders here.
#include <item_ids_text.h>

namespace hemitex::reference {
namespace {

/// Makes a buffer for a binding of the shaders.
void bindStorage(GLuint binding, const auto& array) {
  const std::span content = std::as_bytes(std::span(array));
  if (content.size() > static_cast<std::size_t>(openGlLimit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)))
    throw raster::InputError("the draw list is larger than the buffers of the OpenGL device",
                             "use fewer triangles or smaller index maps");
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, makeBuffer(content));
}

class Shader final : public OpenGlPipeline {
 public:
  explicit Shader(const raster::DrawList& list) : list_(list) {
    useProgram(itemIdsVertexText, itemIdsFragmentText);
    bindStorage(0, shaderCorners(list));
    bindStorage(1, shaderDraws(list));
    bindStorage(2, shaderTexels(list));
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, makeBuffer());
  }
  GLenum textureTarget() const override { return GL_NONE; }
  void setView(const raster::Face& face, const DeviceViewport& viewport) override {
    const ShaderView view = shaderView(face, list_, viewport);
    glBufferData(GL_UNIFORM_BUFFER, sizeof view, &view, GL_STREAM_DRAW);
  }
  /// Each corner has the number of its draw.
  bool joins(const raster::Draw&, const raster::Draw&) const override { return true; }
  void draw(const raster::Draw&, const VertexRuns& runs) override {
    const int triangles = shaderTriangles(list_);
    VertexRuns invocations = runs;
    for (int& first : invocations.first) first *= triangles;
    for (int& count : invocations.count) count *= triangles;
    drawRuns(invocations);
  }

 private:
  const raster::DrawList& list_;
};

}  // namespace

std::unique_ptr<OpenGlPipeline> makeShader(const raster::DrawList& list) { return std::make_unique<Shader>(list); }

}  // namespace hemitex::reference
