/// The raster rules by brute force in rational arithmetic: an independent evaluator of item buffers, which tests every
/// triangle at every pixel. `vector check --exact` judges the reference renderer and devices by it. Independence is its
/// purpose: it shares only the input types with the reference renderer, and uses different methods where it can:
///
/// - Coverage moves the sample by (epsilon, epsilon^2) instead of naming top and left edges. A sample on an edge that
///   is not horizontal moves inside exactly where the interior is at larger i, one on a horizontal edge exactly where
///   it is at larger j: the same rule, without a case for it.
/// - Depth and texture coordinates are quotients of rational numbers instead of integers with cleared denominators.
///
/// Only what the rules define in binary32 and binary64 (the vertex stage, clipping, snapping) is computed so.
#pragma once

#include <cstdint>
#include <span>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

/// What `face` sees of `list`, by the letter of the rules; `skipped` as in raster::ItemBufferRenderer. The cost is
/// pixels times triangles. Throws InputError where the list or the face break the rules.
raster::ItemBuffer evaluateRules(const raster::DrawList& list, const raster::Face& face,
                                 std::span<const std::uint32_t> skipped = {});

}  // namespace hemitex::reference
