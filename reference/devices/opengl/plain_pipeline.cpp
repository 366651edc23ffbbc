/// The pipeline that an application has by default: a 4x4 matrix, unit texture coordinates, a sampler with the nearest
/// filter, clipping at the sides of the face, and the depth of the perspective projection. Positions in clip space,
/// provoking vertices and stored depths are those of the API.
///
/// It has none of the remedies of the other pipelines, and shows what they are worth. It is as fast as plain means
/// allow: triangles share vertices, one call draws neighbours in the list with the same index map, and the fragment
/// shader adds a texel to an offset. Clamping takes several times as long, so only lists with sums that exceed a
/// channel are drawn with it.
#include <algorithm>
#include <array>
#include <bit>
#include <glm/glm.hpp>
#include <map>
#include <vector>

#include "reference/devices/opengl/pipeline.h"
#include "reference/devices/shader_inputs.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

constexpr const char* vertexText = R"(#version 450
layout(location = 0) in vec3 position;
layout(location = 1) in vec2 texcoord;
layout(location = 2) in uint drawOffset;
layout(location = 3) in float clipZ;
layout(location = 0) uniform mat4 matrix;
layout(location = 4) uniform bool isClipSpace;
layout(location = 5) uniform vec2 sampleOffset;  // in clip space, for w = 1
out vec2 uv;
flat out uint offset;

void main() {
  gl_Position = matrix * vec4(position, 1);
  if (isClipSpace) gl_Position.z = clipZ;
  gl_Position.xy += sampleOffset * gl_Position.w;
  uv = texcoord;
  offset = drawOffset;
}
)";

constexpr const char* integerSumText = R"(#version 450
layout(location = 3) uniform uint allBits;
uint sum(uint a, uint b) { return (a + b) & allBits; }
)";

constexpr const char* clampedSumText = R"(#version 450
layout(location = 3) uniform uint channelEnds;  // the highest bit of each channel
uint sum(uint a, uint b) {
  uint sum = 0u, low = 1u;
  for (uint ends = channelEnds; ends != 0u; ends &= ends - 1u) {
    uint next = (ends & -ends) << 1, channel = next - low;
    uint x = a & channel, y = b & channel;
    sum |= y + min(x, channel - y);
    low = next;
  }
  return sum;
}
)";

constexpr const char* fragmentText = R"(
layout(location = 1) uniform uint back;
layout(location = 2) uniform bool hasBack;
layout(binding = 0) uniform usampler2D map;
in vec2 uv;
flat in uint offset;
layout(location = 0) out uint id;
layout(location = 1) out float passed;  // where pixels hold counts, a blend unit adds it

void main() {
  passed = 1;
  uint texel = texture(map, uv).x;
  if (hasHoles && texel == ~0u) discard;
  id = hasBack && !gl_FrontFacing ? back : sum(offset, isNumbered ? 0u : texel);
}
)";

/// Devices test depths early where they know that no fragment is discarded.
std::string constantsOf(const raster::DrawList& list) {
  const auto constant = [](const std::string& name, bool value) {
    return "const bool " + name + (value ? " = true;\n" : " = false;\n");
  };
  return constant("hasHoles", std::any_of(list.indexMaps.begin(), list.indexMaps.end(), raster::hasHoles)) +
         constant("isNumbered", list.value != raster::PixelValue::ItemIds);
}

/// The largest value of each channel of a map's item IDs, holes aside.
ItemId largestChannels(const raster::IndexMap& map, const raster::IdFormat& format) {
  ItemId largest = 0;
  int shift = 0;
  for (const int bits : format.channelBits) {
    const ItemId channel = raster::backgroundId({{bits}}) << shift;
    ItemId ofChannel = 0;
    for (const ItemId id : map.ids) ofChannel = std::max(ofChannel, id == raster::holeTexel ? 0 : id & channel);
    largest |= ofChannel;
    shift += bits;
  }
  return largest;
}

/// Whether a sum of offset and texel exceeds a channel.
bool clamps(const raster::DrawList& list) {
  if (list.blend != raster::Blend::ClampedAdd || list.value != raster::PixelValue::ItemIds) return false;
  std::vector<ItemId> largest;
  for (const raster::IndexMap& map : list.indexMaps) largest.push_back(largestChannels(map, list.format));
  return std::any_of(list.draws.begin(), list.draws.end(), [&](const raster::Draw& draw) {
    if (!draw.indexMap) return false;
    const ItemId texel = largest[static_cast<std::size_t>(*draw.indexMap)];
    return blend(list.format, list.blend, draw.offset, texel) != draw.offset + texel;
  });
}

/// The bits of position, texture coordinates, offset and z, which have an order even where a number is not finite.
using Vertex = std::array<std::uint32_t, 7>;

/// The offset of a vertex: that of its draw, 0 if texels replace it, or the number of its triangle if pixels hold that.
/// With vertex values the device takes that of the provoking vertex.
ItemId offsetOf(const raster::DrawList& list, const raster::Draw& draw, std::uint32_t index) {
  if (list.value == raster::PixelValue::VertexValues) return draw.offset + list.vertexValues[list.indices[index]];
  if (list.value != raster::PixelValue::ItemIds) return raster::flatValue(list, draw, index / 3);
  return draw.indexMap && list.blend == raster::Blend::Replace ? 0 : draw.offset;
}

Vertex vertexOf(const raster::DrawList& list, const raster::Draw& draw, std::uint32_t index) {
  const auto bits = [](float number) { return std::bit_cast<std::uint32_t>(number); };
  const std::uint32_t vertex = list.indices[index];
  const glm::vec3& position = list.positions[vertex];
  const glm::vec2& texcoord = list.texcoords[vertex];
  return {bits(position.x),
          bits(position.y),
          bits(position.z),
          bits(texcoord.x),
          bits(texcoord.y),
          offsetOf(list, draw, index),
          bits(list.clipZ.empty() ? 0 : list.clipZ[vertex])};
}

/// Makes and binds buffers of the vertices of all draws, and of the index of each corner, draw after draw. Corners with
/// equal values share a vertex.
void uploadVertices(const raster::DrawList& list) {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::map<Vertex, std::uint32_t> known;
  for (const raster::Draw& draw : list.draws)
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; ++i) {
      const Vertex vertex = vertexOf(list, draw, i);
      const auto [place, isNew] = known.try_emplace(vertex, static_cast<std::uint32_t>(vertices.size()));
      if (isNew) vertices.push_back(vertex);
      indices.push_back(place->second);
    }
  glBindVertexBuffer(0, makeBuffer(std::as_bytes(std::span(vertices))), 0, sizeof(Vertex));
  glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, makeBuffer(std::as_bytes(std::span(indices))));
  glVertexAttribFormat(0, 3, GL_FLOAT, GL_FALSE, 0);
  glVertexAttribFormat(1, 2, GL_FLOAT, GL_FALSE, 12);
  glVertexAttribIFormat(2, 1, GL_UNSIGNED_INT, 20);
  glVertexAttribFormat(3, 1, GL_FLOAT, GL_FALSE, 24);
  for (GLuint attribute = 0; attribute < 4; ++attribute) {
    glVertexAttribBinding(attribute, 0);
    glEnableVertexAttribArray(attribute);
  }
}

class Plain final : public OpenGlPipeline {
 public:
  explicit Plain(const raster::DrawList& list) {
    const bool isClamped = clamps(list);
    useProgram(vertexText, (isClamped ? clampedSumText : integerSumText) + constantsOf(list) + fragmentText);
    glUniform1ui(3, isClamped ? channelEnds(list.format) : raster::backgroundId(list.format));
    glUniform1i(4, list.clipDepth != raster::ClipDepth::None);
    glProvokingVertex(list.provoking == raster::Provoking::First ? GL_FIRST_VERTEX_CONVENTION
                                                                 : GL_LAST_VERTEX_CONVENTION);
    uploadVertices(list);
  }
  GLenum textureTarget() const override { return GL_TEXTURE_2D; }
  int viewportWidth() const override { return 1; }
  void setView(const raster::Face& face, const DeviceViewport& viewport) override;
  /// Each vertex has the offset of its draw.
  bool joins(const raster::Draw& draw, const raster::Draw& next) const override {
    return draw.back == next.back && draw.indexMap == next.indexMap && draw.cull == next.cull;
  }
  void draw(const raster::Draw& draw, const VertexRuns& runs) override;
};

/// In a scene the depth is 1 - n/w, that of a perspective projection without a far plane.
void Plain::setView(const raster::Face& face, const DeviceViewport& viewport) {
  const auto row = [&face](const glm::vec3& axis, float added) {
    return glm::vec4(axis, added - glm::dot(axis, face.eye));
  };
  const glm::mat4 rows(row(face.x, 0), row(face.y, 0), row(face.w, -face.nearDistance), row(face.w, 0));
  glUniformMatrix4fv(0, 1, GL_TRUE, &rows[0][0]);
  const float halfPixels = face.sample == raster::SamplePlace::Corner ? 1 : 0;
  glUniform2f(5, halfPixels / static_cast<float>(viewport.columns), halfPixels / static_cast<float>(viewport.rows));
}

void Plain::draw(const raster::Draw& draw, const VertexRuns& runs) {
  glUniform1ui(1, draw.back.value_or(0));
  glUniform1i(2, draw.back.has_value());
  draw.cull == raster::Cull::None ? glDisable(GL_CULL_FACE) : glEnable(GL_CULL_FACE);
  glCullFace(draw.cull == raster::Cull::Front ? GL_FRONT : GL_BACK);
  std::vector<const void*> first;  // in the index buffer
  for (const int index : runs.first)
    first.push_back(reinterpret_cast<const void*>(static_cast<std::size_t>(index) * sizeof(GLuint)));
  glMultiDrawElements(GL_TRIANGLES, runs.count.data(), GL_UNSIGNED_INT, first.data(),
                      static_cast<GLsizei>(first.size()));
}

}  // namespace

std::unique_ptr<OpenGlPipeline> makePlain(const raster::DrawList& list) { return std::make_unique<Plain>(list); }

}  // namespace hemitex::reference
