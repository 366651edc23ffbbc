/// A renderer on a real device: OpenGL through EGL, without a window. It is an example of a backend for this method,
/// and it provides a device for verdicts (verdict.h).
///
/// This file holds textures, framebuffer and viewport. The context is in context.h and the interface of the pipelines
/// in pipeline.h. Vertex data is in texel_triangles.h, joined draws are in batches.h.
///
/// By default a device differs from docs/item-buffers.md in four ways. Each has a remedy here, except on the plain
/// path:
/// - It clips triangles at the sides of its view. The view is as wide as the guard band of the rules, and the
///   framebuffer shows its scissor rectangle.
/// - It has its own snapping and interpolates between corners that are not snapped. Corners are put on sub-pixels
///   beforehand; the shaders clip at the near plane before that.
/// - It rounds u N before the floor function. Texture coordinates are in texels.
/// - It interpolates in binary32. The two pipelines solve this in different ways.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::reference {

enum class OpenGlPath {
  /// As in Nielsen and Christensen (2002), without shaders. An index map is a texture with 8 bits per channel, and an
  /// offset is the flat colour of its triangles. The texture environment adds the two. The vertex stage runs on the
  /// CPU. The depth is n/w, whose steps are finest far away, where it changes least.
  FixedFunction,
  /// Index maps are buffers of 32-bit integers, and shaders do the rest: the vertex stage by the rules, depth and
  /// texels
  /// in double precision, and item IDs of any format. Vulkan uses the same shaders.
  Shader,
  /// What an application does by default, without any remedy: a matrix, unit texture coordinates, a sampler, and the
  /// clipping of the API. It shows what the remedies of the other paths are worth, and what they cost.
  Plain,
};

class OpenGlRenderer final : public raster::ItemBufferRenderer {
 public:
  /// Throws InputError if the list breaks the rules, there is no device (see context.h), or an index map exceeds the
  /// device's textures, on the shader path its buffers. Also throws it if the path cannot draw the list. Fixed-function
  /// hardware adds only channels of 8 bits with clamping and, in any format, item IDs that share no bits.
  OpenGlRenderer(const raster::DrawList& list, OpenGlPath path);
  ~OpenGlRenderer() override;

  /// Throws InputError if a face breaks the rules or exceeds the device's viewport, or if the device fails. The
  /// fixed-function path draws the fronts of a draw before its backs: at equal depths the front is visible.
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::reference
