/// Form-factor rows in closed form: averages over the area of elements, without blockers.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "reference/truth/closed_forms/surface_pieces.h"

namespace hemitex::reference {

/// From `elements` of `from`, together, to each element of `to`. Both are pieces of one scene, in two discretizations
/// or the same one. The error per pair of pieces is 1e-9 of its form factor, or 1e-14 (see polygon_to_polygon.h).
/// Blockers are ignored, so that a row may sum to more than 1. Takes a few microseconds per pair of pieces that see
/// each other, and longer for pairs that are near; slivers take a thousand times as long.
std::vector<double> analyticRow(const SurfacePieces& from, std::span<const std::uint32_t> elements,
                                const SurfacePieces& to);

}  // namespace hemitex::reference
