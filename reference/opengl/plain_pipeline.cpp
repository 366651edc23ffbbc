#include "reference/opengl/plain_pipeline.h"

#include "reference/opengl/shader_programs.h"
#include "reference/opengl/vertex_buffers.h"

namespace hemitex::reference {
namespace {

class Plain final : public OpenGlPipeline {
 public:
  explicit Plain(const raster::DrawList& list);
  OpenGlPixels pixels() const override { return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}; }
  GLenum textureTarget() const override { return GL_TEXTURE_2D; }
  int viewportWidth() const override { return 1; }
  void clear(raster::ItemId background) override;
  void setView(const raster::Face& face, int width) override;
  bool joins(const raster::Draw&, const raster::Draw&) const override { return false; }
  void draw(const raster::Draw& draw, const VertexRuns& runs) override;

 private:
  raster::Blend blend_;
};

Plain::Plain(const raster::DrawList& list) : blend_(list.blend) {
  glUseProgram(linkPlainPrograms());
  setFormat(list.format);
  glDepthFunc(GL_LESS);
  uploadCorners(list, VertexAttribute::position, VertexAttribute::texcoord);
}

void Plain::clear(raster::ItemId background) {
  const float farthest = 1;
  glClearBufferuiv(GL_COLOR, 0, &background);
  glClearBufferfv(GL_DEPTH, 0, &farthest);
}

/// The depth is 1 - n/w, that of a perspective projection without a far plane.
void Plain::setView(const raster::Face& face, int) {
  const auto row = [&face](const glm::vec3& axis, float added) {
    return glm::vec4(axis, added - glm::dot(axis, face.eye));
  };
  const glm::mat4 rows(row(face.x, 0), row(face.y, 0), row(face.w, -face.nearDistance), row(face.w, 0));
  glUniformMatrix4fv(PlainUniform::matrix, 1, GL_TRUE, &rows[0][0]);
}

void Plain::draw(const raster::Draw& draw, const VertexRuns& runs) {
  glUniform1ui(PlainUniform::offset, draw.offset);
  setBlend(draw, blend_);
  drawRuns(runs);
}

}  // namespace

std::unique_ptr<OpenGlPipeline> makePlain(const raster::DrawList& list) { return std::make_unique<Plain>(list); }

}  // namespace hemitex::reference
