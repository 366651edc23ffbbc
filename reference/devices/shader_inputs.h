/// The inputs of the shaders: the twins of shader_inputs.glsl, byte for byte. The draw list is in three arrays, which
/// are the same for all views. A view is in push constants of Vulkan, or in a uniform block of OpenGL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "reference/devices/viewport.h"

namespace hemitex::reference {

/// A corner of a triangle.
struct ShaderCorner {
  glm::vec3 position;  ///< in clip space x, y and w
  float z;             ///< in clip space; -1 in a scene, whose depths are of -1/w
  glm::vec2 texcoord;
  std::uint32_t draw;     ///< in the array of draws
  raster::ItemId number;  ///< the value of the triangle where pixels hold no item IDs
};

struct ShaderDraw {
  raster::ItemId offset;
  raster::ItemId back;
  std::uint32_t hasBack;
  std::uint32_t firstTexel;  ///< of its index map, in the array of texels
  int width, height;         ///< of its index map; 0 without one
  int cull;                  ///< raster::Cull
};

/// The members are ordered such that GLSL needs no padding.
struct alignas(16) ShaderView {
  glm::vec3 eye;
  float near;
  glm::vec3 x;
  float sampleOffset;  ///< added to snapped corners, in sub-pixels
  glm::vec3 y;
  std::uint32_t channelEnds;
  glm::vec3 w;
  raster::Blend blend;
  glm::vec2 scissor;   ///< first column and row
  glm::vec2 size;      ///< columns and rows of the face
  glm::vec2 viewport;  ///< columns and rows of the device's viewport
  int value;           ///< raster::PixelValue
  int clipDepth;       ///< raster::ClipDepth
  float depthScale;    ///< depths are scale z/w + offset; with a scale of 0 they are w
  float depthOffset;
};
static_assert(sizeof(ShaderCorner) == 32 && sizeof(ShaderDraw) == 28 && sizeof(ShaderView) == 112);

/// The highest bit of each channel.
std::uint32_t channelEnds(const raster::IdFormat& format);
/// Three corners per triangle, draw after draw, of an assembled list.
std::vector<ShaderCorner> shaderCorners(const raster::DrawList& list);
std::vector<ShaderDraw> shaderDraws(const raster::DrawList& list);
/// The item IDs of all index maps, one map after the other.
std::vector<raster::ItemId> shaderTexels(const raster::DrawList& list);
ShaderView shaderView(const raster::Face& face, const raster::DrawList& list, const DeviceViewport& viewport);

/// The number of triangles that the vertex shader makes of each: what clipping at planes of w and z leaves at most.
inline int shaderTriangles(const raster::DrawList& list) { return list.clipDepth == raster::ClipDepth::None ? 2 : 4; }

}  // namespace hemitex::reference
