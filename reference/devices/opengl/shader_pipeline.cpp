#include "reference/devices/opengl/shader_pipeline.h"

#include <span>
#include <string>

#include "raster/base/input_error.h"
#include "reference/devices/opengl/context.h"
#include "reference/devices/opengl/shader_programs.h"
#include "reference/devices/opengl/vertex_buffers.h"
#include "reference/devices/shader_inputs.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

/// Makes a buffer for a binding of the shaders.
template <typename Array>
void bindStorage(GLuint binding, const Array& array) {
  const std::size_t bytes = std::span(array).size_bytes();
  if (bytes > static_cast<std::size_t>(openGlLimit(GL_MAX_SHADER_STORAGE_BLOCK_SIZE)))
    throw raster::InputError("the draw list is larger than the buffers of the OpenGL device",
                             "use fewer triangles or smaller index maps");
  GLuint buffer = 0;
  glGenBuffers(1, &buffer);
  glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer);
  glBufferData(GL_SHADER_STORAGE_BUFFER, static_cast<GLsizeiptr>(bytes), array.data(), GL_STATIC_DRAW);
}

class Shader final : public OpenGlPipeline {
 public:
  explicit Shader(const raster::DrawList& list);
  OpenGlPixels pixels() const override { return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}; }
  GLenum textureTarget() const override { return GL_NONE; }
  void clear(ItemId background) override;
  void setView(const raster::Face& face, int width) override;
  /// Each corner has the number of its draw.
  bool joins(const raster::Draw&, const raster::Draw&) const override { return true; }
  void draw(const raster::Draw& draw, const VertexRuns& runs) override;

 private:
  const raster::DrawList& list_;
};

Shader::Shader(const raster::DrawList& list) : list_(list) {
  glUseProgram(linkShaderPrograms());
  glDepthFunc(GL_LESS);
  bindStorage(0, shaderCorners(list));
  bindStorage(1, shaderDraws(list));
  bindStorage(2, shaderTexels(list));
  GLuint view = 0;
  glGenBuffers(1, &view);
  glBindBufferBase(GL_UNIFORM_BUFFER, 0, view);
}

void Shader::clear(ItemId background) {
  const float farthest = 1;
  glClearBufferuiv(GL_COLOR, 0, &background);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void Shader::setView(const raster::Face& face, int width) {
  const ShaderView view = shaderView(face, list_, width);
  glBufferData(GL_UNIFORM_BUFFER, sizeof view, &view, GL_STREAM_DRAW);
}

/// Six invocations per triangle (item_ids.vert).
void Shader::draw(const raster::Draw&, const VertexRuns& runs) {
  VertexRuns doubled = runs;
  for (int& first : doubled.first) first *= 2;
  for (int& count : doubled.count) count *= 2;
  drawRuns(doubled);
}

}  // namespace

std::unique_ptr<OpenGlPipeline> makeShader(const raster::DrawList& list) { return std::make_unique<Shader>(list); }

}  // namespace hemitex::reference
