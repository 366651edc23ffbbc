#include "reference/opengl/batches.h"

#include <algorithm>

namespace hemitex::reference {
namespace {

/// Adds the vertices of a draw, which begin at `first`, except those of skipped triangles.
void addVertices(VertexRuns& runs, const raster::Draw& draw, GLint first, std::span<const std::uint32_t> skipped) {
  GLint vertex = first;
  for (auto skip = std::lower_bound(skipped.begin(), skipped.end(), draw.first / 3);
       skip != skipped.end() && 3 * *skip < draw.first + draw.count; ++skip) {
    const GLint hole = first + static_cast<GLint>(3 * *skip - draw.first);
    runs.add(vertex, hole);
    vertex = hole + 3;
  }
  runs.add(vertex, first + static_cast<GLint>(draw.count));
}

}  // namespace

void VertexRuns::add(GLint from, GLint end) {
  if (from == end) return;
  if (!first.empty() && first.back() + count.back() == from) {
    count.back() += end - from;
    return;
  }
  first.push_back(from);
  count.push_back(end - from);
}

void VertexRuns::draw() const {
  glMultiDrawArrays(GL_TRIANGLES, first.data(), count.data(), static_cast<GLsizei>(first.size()));
}

std::vector<DrawBatch> batchesOf(const raster::DrawList& list, std::span<const std::uint32_t> skipped,
                                 const DrawsJoin& join) {
  std::vector<DrawBatch> batches;
  GLint first = 0;
  for (const raster::Draw& draw : list.draws) {
    if (batches.empty() || !join(*batches.back().draw, draw)) batches.push_back({&draw, {}});
    addVertices(batches.back().runs, draw, first, skipped);
    first += static_cast<GLint>(draw.count);
  }
  return batches;
}

}  // namespace hemitex::reference
