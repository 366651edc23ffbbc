/// A failing test vector made small while a device is at hand: every smaller vector is drawn again.
///
/// Parts are removed in runs of halves, then of quarters, down to single ones (delta debugging: Zeller and Hildebrandt,
/// Simplifying and Isolating Failure-Inducing Input, 2002).
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "reference/conformance/trace/fragments.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// The list with only these triangles, given in draw order, and with the draws and index maps that they use.
raster::DrawList withTriangles(const raster::DrawList& list, std::span<const DrawnTriangle> triangles);

/// The list without vertices that no triangle uses.
raster::DrawList withUsedVertices(raster::DrawList list);

/// Removes triangles until each one is needed for `fails`. Requires that all of them together fail.
std::vector<DrawnTriangle> fewestTriangles(std::vector<DrawnTriangle> triangles,
                                           const std::function<bool(std::span<const DrawnTriangle>)>& fails);

/// Removes faces, triangles, rows and columns of pixels, rows and columns of index maps, and vertices, as long as
/// `fails` stays true: until no single one of them can go. Two vertices become one by taking the place of the other.
/// Requires that `vector` fails. The viewports keep their size. It calls `fails` at most `maxRuns` times, and then
/// returns the smallest vector so far.
TestVector reduce(TestVector vector, const std::function<bool(const TestVector&)>& fails, std::size_t maxRuns);

}  // namespace hemitex::reference
