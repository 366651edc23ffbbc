/// How OpenGL gets from the vertices of a draw to item IDs: what the two paths of OpenGlRenderer do each in their way.
/// One is in fixed_function_pipeline.h, the other in shader_pipeline.h.
///
/// Clip coordinates are (x / width, y / width, n, w), where a unit of x / w is half the side of the face and the
/// viewport is `width` times as wide as the face: the device cuts triangles at the sides of its view, and so far out
/// that cuts no edge where it is seen.
#pragma once

#include <epoxy/gl.h>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "reference/opengl/batches.h"

namespace hemitex::reference {

/// How item IDs lie in textures and framebuffers.
struct OpenGlPixels {
  GLint storage;
  GLenum format, type;
};

/// Every call is made while the renderer's context is in use.
class OpenGlPipeline {
 public:
  virtual ~OpenGlPipeline() = default;
  virtual OpenGlPixels pixels() const = 0;
  /// Every item ID becomes `background`, every depth the farthest.
  virtual void clear(raster::ItemId background) = 0;
  virtual void setView(const raster::Face& face, int width) = 0;
  /// Draws that join are drawn as one.
  virtual bool joins(const raster::Draw& draw, const raster::Draw& next) const = 0;
  /// With the texture of the draw's index map bound, where it has one.
  virtual void draw(const raster::Draw& draw, const VertexRuns& runs) = 0;
};

}  // namespace hemitex::reference
