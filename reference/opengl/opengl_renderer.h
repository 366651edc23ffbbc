/// A renderer on a real device: OpenGL through EGL, without a window. It shows what a backend for this method looks
/// like, and gives the verdicts (verdict.h) a device to judge.
///
/// The renderer itself holds textures, framebuffer and viewport. A context to work in is in context.h, triangles
/// as the device is given them in vertices.h, what it draws with one call in batches.h, and what the two
/// paths do each in their way in pipeline.h.
///
/// Left to itself a device departs from the raster rules in four ways, and each has its remedy here. It cuts triangles
/// at the sides of its view: the view is as wide as the rules' guard band, and the framebuffer shows the scissor
/// rectangle of it. It snaps in its own way and interpolates between corners that are not snapped: corners are put on
/// sub-pixels before it sees them. It rounds u N before the floor is taken: textures are addressed in texels. And it
/// interpolates in binary32, which the two paths meet each in their way.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::reference {

enum class OpenGlPath {
  /// As in Nielsen and Christensen (2002): no program runs on the device. An index map is a texture of 8 bits a
  /// channel, an offset the flat colour of its triangles, and the texture environment adds the two. The vertex stage
  /// runs on the CPU; the depth is n/w, whose steps are finest far away, where it changes least.
  FixedFunction,
  /// Index maps are textures of 32-bit integers, and programs do the rest: the vertex stage by the rules, depth and
  /// texels in binary64, and item IDs of any format.
  Shader,
};

class OpenGlRenderer final : public raster::ItemBufferRenderer {
 public:
  /// Throws InputError where the list breaks the rules, where no device is there (see openGlDevice), where an index map
  /// is larger than the device's textures, and where the path cannot draw the list: all that fixed-function hardware
  /// adds is channels of 8 bits that clamp, and, in any format, item IDs that share no bits.
  OpenGlRenderer(const raster::DrawList& list, OpenGlPath path);
  ~OpenGlRenderer() override;

  /// Throws InputError where a face breaks the rules or is larger than the device's viewport, and where the device
  /// fails. The fixed-function path draws the fronts of a draw before its backs: where both lie at one depth, the front
  /// is seen.
  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// Vendor, renderer and version of the device that OpenGlRenderer draws on, as its driver names them; nothing where EGL
/// finds none with the compatibility profile of OpenGL 4.5.
std::optional<std::string> openGlDevice();

}  // namespace hemitex::reference
