/// Vertex buffers, and draws from them.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>

#include "reference/devices/batches.h"

namespace hemitex::reference {

/// Creates, binds and fills a vertex buffer; `data` may be null for a buffer that is filled later.
void makeVertexBuffer(const void* data, std::size_t bytes, GLenum usage);

/// Makes a vertex buffer with the positions and texture coordinates of all corners, draw after draw, and binds it to
/// the attributes of these locations.
void uploadCorners(const raster::DrawList& list, GLuint position, GLuint texcoord);

/// The offset of a vertex's member in the bound buffer, in the type that OpenGL expects.
const void* vertexOffset(std::size_t offset);

/// Draws the runs in their order from the bound buffers.
void drawRuns(const VertexRuns& runs);

}  // namespace hemitex::reference
