#include "reference/devices/opengl/plain_pipeline.h"

#include <algorithm>
#include <vector>

#include "reference/devices/opengl/shader_programs.h"
#include "reference/devices/opengl/vertex_buffers.h"

namespace hemitex::reference {
namespace {

/// The largest value of each channel of a map's item IDs.
raster::ItemId largestChannels(const raster::IndexMap& map, const raster::IdFormat& format) {
  raster::ItemId largest = 0;
  int shift = 0;
  for (const int bits : format.channelBits) {
    const raster::ItemId channel = raster::backgroundId({{bits}}) << shift;
    raster::ItemId ofChannel = 0;
    for (const raster::ItemId id : map.ids) ofChannel = std::max(ofChannel, id & channel);
    largest |= ofChannel;
    shift += bits;
  }
  return largest;
}

/// Whether a sum of offset and texel exceeds a channel.
bool clamps(const raster::DrawList& list) {
  if (list.blend != raster::Blend::ClampedAdd) return false;
  std::vector<raster::ItemId> largest;
  for (const raster::IndexMap& map : list.indexMaps) largest.push_back(largestChannels(map, list.format));
  return std::any_of(list.draws.begin(), list.draws.end(), [&](const raster::Draw& draw) {
    if (!draw.indexMap) return false;
    const raster::ItemId texel = largest[static_cast<std::size_t>(*draw.indexMap)];
    return blend(list.format, list.blend, draw.offset, texel) != draw.offset + texel;
  });
}

class Plain final : public OpenGlPipeline {
 public:
  explicit Plain(const raster::DrawList& list);
  OpenGlPixels pixels() const override { return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}; }
  GLenum textureTarget() const override { return GL_TEXTURE_2D; }
  int viewportWidth() const override { return 1; }
  void clear(raster::ItemId background) override;
  void setView(const raster::Face& face, int width) override;
  /// Each vertex has the offset of its draw.
  bool joins(const raster::Draw& draw, const raster::Draw& next) const override {
    return draw.back == next.back && draw.indexMap == next.indexMap;
  }
  void draw(const raster::Draw& draw, const VertexRuns& runs) override;
};

Plain::Plain(const raster::DrawList& list) {
  glUseProgram(linkPlainPrograms(clamps(list)));
  setFormat(list.format);
  glDepthFunc(GL_LESS);
  uploadVertices(list);
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
  glUniformMatrix4fv(Uniform::matrix, 1, GL_TRUE, &rows[0][0]);
}

void Plain::draw(const raster::Draw& draw, const VertexRuns& runs) {
  setBack(draw);
  drawIndexedRuns(runs);
}

}  // namespace

std::unique_ptr<OpenGlPipeline> makePlain(const raster::DrawList& list) { return std::make_unique<Plain>(list); }

}  // namespace hemitex::reference
