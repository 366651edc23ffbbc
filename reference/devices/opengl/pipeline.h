/// The interface of the pipelines of OpenGlRenderer, which convert the vertices of a draw to item IDs:
/// fixed_function_pipeline.h, shader_pipeline.h and plain_pipeline.h.
///
/// Clip coordinates are (x / width, y / width, z, w), where a unit of x / w is half the side of the face. The viewport
/// is `width` times as wide as the face. With a width of 8 the device clips triangles at sides so far out that clipping
/// changes no visible edge.
#pragma once

#include <epoxy/gl.h>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "reference/devices/batches.h"

namespace hemitex::reference {

/// The format of item IDs in textures and framebuffers.
struct OpenGlPixels {
  GLint storage;
  GLenum format, type;
};

/// All calls require that the renderer's context is current.
class OpenGlPipeline {
 public:
  virtual ~OpenGlPipeline() = default;
  virtual OpenGlPixels pixels() const = 0;
  /// GL_TEXTURE_RECTANGLE for coordinates in texels, GL_TEXTURE_2D for unit coordinates, GL_NONE without textures.
  virtual GLenum textureTarget() const { return GL_TEXTURE_RECTANGLE; }
  /// The width that the viewport should have, in faces; less on devices with small viewports.
  virtual int viewportWidth() const { return 8; }
  /// Sets all item IDs to `background`, and all depths to the farthest.
  virtual void clear(raster::ItemId background) = 0;
  virtual void setView(const raster::Face& face, int width) = 0;
  /// Whether both draws can be drawn as one.
  virtual bool joins(const raster::Draw& draw, const raster::Draw& next) const = 0;
  /// Requires that the texture of the draw's index map is bound, if there are textures; without a map, a texture of a
  /// single texel 0.
  virtual void draw(const raster::Draw& draw, const VertexRuns& runs) = 0;
};

}  // namespace hemitex::reference
