/// The interface of the pipelines of makeOpenGlRenderer, which convert the vertices of a draw to item IDs, and what
/// several of them use. fixed_function_pipeline.cpp, shader_pipeline.cpp and plain_pipeline.cpp say how each draws.
///
/// Clip coordinates are (x, y, z, w), where a unit of x / w is half the side of the device's viewport. It is up to 8
/// times as wide as the face (viewport.h), so that the device clips triangles at sides so far out that clipping changes
/// no visible edge.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>
#include <memory>
#include <span>
#include <string>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "reference/devices/batches.h"
#include "reference/devices/viewport.h"

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
  virtual OpenGlPixels pixels() const { return {GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT}; }
  /// GL_TEXTURE_RECTANGLE for coordinates in texels, GL_TEXTURE_2D for unit coordinates, GL_NONE without textures.
  virtual GLenum textureTarget() const = 0;
  /// The width that the viewport should have, in faces; less on devices with small viewports.
  virtual int viewportWidth() const { return 8; }
  /// Whether larger depths are nearer.
  virtual bool hasReversedDepths() const { return false; }
  /// Sets all item IDs to `background`.
  virtual void clear(raster::ItemId background) const { glClearBufferuiv(GL_COLOR, 0, &background); }
  virtual void setView(const raster::Face& face, const DeviceViewport& viewport) = 0;
  /// Whether both draws can be drawn as one.
  virtual bool joins(const raster::Draw& draw, const raster::Draw& next) const = 0;
  /// Requires that the texture of the draw's index map is bound, if there are textures; without a map, a texture of a
  /// single texel 0.
  virtual void draw(const raster::Draw& draw, const VertexRuns& runs) = 0;
};

/// For hardware without shaders. Requires a current context. Throws InputError if a clamped add per byte does not give
/// the item IDs of the list. It does for channels of 8 bits with a clamped add, and in any format for item IDs that
/// share no bits.
std::unique_ptr<OpenGlPipeline> makeFixedFunction(const raster::DrawList& list);
/// As an application has it by default. Requires a current context. Throws InputError if the driver rejects the
/// programs.
std::unique_ptr<OpenGlPipeline> makePlain(const raster::DrawList& list);
/// By shaders that implement all rules of docs/item-buffers.md. Requires a current context. Throws InputError if the
/// driver rejects the programs, or if the index maps exceed a buffer of the device.
std::unique_ptr<OpenGlPipeline> makeShader(const raster::DrawList& list);

/// Compiles, links and uses two shaders. Throws InputError with the message of the driver if it rejects them.
void useProgram(const std::string& vertexText, const std::string& fragmentText);

/// A new buffer that holds `content`.
GLuint makeBuffer(std::span<const std::byte> content = {});

/// Draws the runs of vertices of the bound buffers, in their order.
void drawRuns(const VertexRuns& runs);

}  // namespace hemitex::reference
