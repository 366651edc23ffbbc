#include "reference/devices/batches.h"

#include <algorithm>

namespace hemitex::reference {
namespace {

/// Adds the vertices in [from, end), which begin at the end of the last run or behind it.
void addRun(VertexRuns& runs, int from, int end) {
  if (from == end) return;
  if (!runs.first.empty() && runs.first.back() + runs.count.back() == from) {
    runs.count.back() += end - from;
  } else {
    runs.first.push_back(from);
    runs.count.push_back(end - from);
  }
}

/// Adds the vertices of a draw, which begin at `first`, except those of skipped triangles.
void addVertices(VertexRuns& runs, const raster::Draw& draw, int first, std::span<const std::uint32_t> skipped) {
  int vertex = first;
  for (auto skip = std::lower_bound(skipped.begin(), skipped.end(), draw.first / 3);
       skip != skipped.end() && 3 * *skip < draw.first + draw.count; ++skip) {
    const int hole = first + static_cast<int>(3 * *skip - draw.first);
    addRun(runs, vertex, hole);
    vertex = hole + 3;
  }
  addRun(runs, vertex, first + static_cast<int>(draw.count));
}

}  // namespace

std::vector<DrawBatch> batchesOf(const raster::DrawList& list, std::span<const std::uint32_t> skipped,
                                 const std::function<bool(const raster::Draw&, const raster::Draw&)>& joins) {
  std::vector<DrawBatch> batches;
  int first = 0;
  for (const raster::Draw& draw : list.draws) {
    if (batches.empty() || !joins(*batches.back().draw, draw)) batches.push_back({&draw, {}});
    addVertices(batches.back().runs, draw, first, skipped);
    first += static_cast<int>(draw.count);
  }
  return batches;
}

}  // namespace hemitex::reference
