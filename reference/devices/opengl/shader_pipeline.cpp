#include "reference/devices/opengl/shader_pipeline.h"

#include "reference/devices/opengl/shader_programs.h"
#include "reference/devices/opengl/vertex_buffers.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

class Shader final : public OpenGlPipeline {
 public:
  explicit Shader(const raster::DrawList& list);
  OpenGlPixels pixels() const override { return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}; }
  void clear(ItemId background) override;
  void setView(const raster::Face& face, int width) override;
  /// Each vertex has the offset of its draw.
  bool joins(const raster::Draw& draw, const raster::Draw& next) const override {
    return draw.back == next.back && draw.indexMap == next.indexMap;
  }
  void draw(const raster::Draw& draw, const VertexRuns& runs) override;

 private:
  raster::Blend blend_;
};

Shader::Shader(const raster::DrawList& list) : blend_(list.blend) {
  glUseProgram(linkShaderPrograms());
  setFormat(list.format);
  glDepthFunc(GL_LESS);
  uploadVertices(list);
}

void Shader::clear(ItemId background) {
  const float farthest = 1;
  glClearBufferuiv(GL_COLOR, 0, &background);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

void Shader::setView(const raster::Face& face, int width) {
  const glm::mat3 columns = glm::transpose(glm::mat3(face.x, face.y, face.w));
  glUniform3fv(Uniform::eye, 1, &face.eye[0]);
  glUniformMatrix3fv(Uniform::columns, 1, GL_FALSE, &columns[0][0]);
  glUniform1f(Uniform::near, face.nearDistance);
  glUniform1d(Uniform::unit, 128.0 * face.resolution);
  glUniform1d(Uniform::width, width);
  glUniform2f(Uniform::corner, static_cast<float>(face.scissor.column), static_cast<float>(face.scissor.row));
}

void Shader::draw(const raster::Draw& draw, const VertexRuns& runs) {
  setBack(draw);
  setOperation(draw, blend_);
  drawIndexedRuns(runs);
}

}  // namespace

std::unique_ptr<OpenGlPipeline> makeShader(const raster::DrawList& list) { return std::make_unique<Shader>(list); }

}  // namespace hemitex::reference
