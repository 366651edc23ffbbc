/// Rows of form factors in closed form: the average over the area of elements, as if nothing stood in the way.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/closed_forms/surface_pieces.h"

namespace hemitex::reference {

/// From `elements` of `from`, together, to every element of `to`: two discretizations of one scene, or the same. Each
/// pair of their pieces is right to 1e-9 (see polygon_to_polygon.h). Blockers are not looked at, so a row may sum to
/// more than 1. The time grows with the pairs of pieces, some 50 us each; slivers take a thousand times as much.
std::vector<double> analyticRow(const SurfacePieces& from, std::span<const std::uint32_t> elements,
                                const SurfacePieces& to);

}  // namespace hemitex::reference
