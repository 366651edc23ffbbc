/// The inputs of the shaders: the twins of shader_inputs.glsl, byte for byte. The draw list is in three arrays, which
/// are the same for all views. A view is in push constants of Vulkan, or in a uniform block of OpenGL.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

/// A corner of a triangle.
struct ShaderCorner {
  glm::vec3 position;
  glm::vec2 texcoord;
  std::uint32_t draw;  ///< in the array of draws
};

struct ShaderDraw {
  raster::ItemId offset;
  raster::ItemId back;
  std::uint32_t hasBack;
  std::uint32_t firstTexel;  ///< of its index map, in the array of texels
  int width, height;         ///< of its index map; 0 without one
  int cull;                  ///< raster::Cull
  int firstTriangle;         ///< in the array of corners / 3
};

/// The members are ordered such that GLSL needs no padding.
struct alignas(16) ShaderView {
  glm::vec3 eye;
  float near;
  glm::vec3 x;
  float resolution;
  glm::vec3 y;
  float width;  ///< of the viewport, in faces
  glm::vec3 w;
  std::uint32_t channelEnds;
  glm::vec2 scissor;  ///< first column and row
  raster::Blend blend;
  int value;  ///< raster::PixelValue
};
static_assert(sizeof(ShaderCorner) == 24 && sizeof(ShaderDraw) == 32 && sizeof(ShaderView) == 80);

/// The highest bit of each channel.
std::uint32_t channelEnds(const raster::IdFormat& format);
/// Three corners per triangle, draw after draw.
std::vector<ShaderCorner> shaderCorners(const raster::DrawList& list);
std::vector<ShaderDraw> shaderDraws(const raster::DrawList& list);
/// The item IDs of all index maps, one map after the other.
std::vector<raster::ItemId> shaderTexels(const raster::DrawList& list);
/// A view of the list whose viewport is `width` times as wide as the face, 1 to 8.
ShaderView shaderView(const raster::Face& face, const raster::DrawList& list, int width);

}  // namespace hemitex::reference
