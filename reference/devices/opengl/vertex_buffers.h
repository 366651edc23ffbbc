/// Vertex buffers, and draws from them.
#pragma once

#include <epoxy/gl.h>

#include <cstddef>

#include "reference/devices/batches.h"

namespace hemitex::reference {

/// Creates, binds and fills a vertex buffer; `data` may be null for a buffer that is filled later.
void makeVertexBuffer(const void* data, std::size_t bytes, GLenum usage);

/// Makes a buffer with the vertices of all draws and binds it to the attributes of VertexAttribute (shader_programs.h).
/// The offset of a vertex is that of its draw, or 0 if texels replace it. Corners with equal values share a vertex. An
/// index buffer has the corners, draw after draw.
void uploadVertices(const raster::DrawList& list);

/// The offset of a vertex's member in the bound buffer, in the type that OpenGL expects.
const void* vertexOffset(std::size_t offset);

/// Draws the runs in their order: of vertices of the bound buffers, or of entries of the bound index buffer.
void drawRuns(const VertexRuns& runs);
void drawIndexedRuns(const VertexRuns& runs);

}  // namespace hemitex::reference
