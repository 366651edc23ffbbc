#include "reference/devices/batches.h"

#include <algorithm>

namespace hemitex::reference {
namespace {

/// Adds the vertices of a draw, which begin at `first`, except those of skipped triangles.
void addVertices(VertexRuns& runs, const raster::Draw& draw, int first, std::span<const std::uint32_t> skipped) {
  int vertex = first;
  for (auto skip = std::lower_bound(skipped.begin(), skipped.end(), draw.first / 3);
       skip != skipped.end() && 3 * *skip < draw.first + draw.count; ++skip) {
    const int hole = first + static_cast<int>(3 * *skip - draw.first);
    runs.add(vertex, hole);
    vertex = hole + 3;
  }
  runs.add(vertex, first + static_cast<int>(draw.count));
}

}  // namespace

void VertexRuns::add(int from, int end) {
  if (from == end) return;
  if (!first.empty() && first.back() + count.back() == from) {
    count.back() += end - from;
    return;
  }
  first.push_back(from);
  count.push_back(end - from);
}

std::vector<DrawBatch> batchesOf(const raster::DrawList& list, std::span<const std::uint32_t> skipped,
                                 const DrawsJoin& join) {
  std::vector<DrawBatch> batches;
  int first = 0;
  for (const raster::Draw& draw : list.draws) {
    if (batches.empty() || !join(*batches.back().draw, draw)) batches.push_back({&draw, {}});
    addVertices(batches.back().runs, draw, first, skipped);
    first += static_cast<int>(draw.count);
  }
  return batches;
}

}  // namespace hemitex::reference
