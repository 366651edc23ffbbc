/// The raster rules by brute force in rational arithmetic: an independent evaluator of item buffers, which tests every
/// triangle at every pixel. `vector check --exact` judges the reference renderer and devices by it. Independence is its
/// purpose: it shares only the input types and parallelFor with the reference renderer, and uses different methods
/// where it can:
///
/// - Coverage moves the sample by (epsilon, epsilon^2) instead of classifying top and left edges. A sample on a
///   horizontal edge moves inside exactly where the interior is at larger j. A sample on any other edge moves inside
///   exactly where the interior is at larger i. This is the top-left rule without a special case.
/// - Depth and texture coordinates are quotients of rational numbers instead of integers with cleared denominators.
///
/// The vertex stage, clipping and snapping use binary32 and binary64, because the rules define them so.
#pragma once

#include <cstdint>
#include <span>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

/// The item buffer of a face. `skipped` holds triangles to leave out, as in raster::ItemBufferRenderer. The cost is
/// pixels times triangles. Throws InputError for an invalid list or face.
raster::ItemBuffer evaluateRules(const raster::DrawList& list, const raster::Face& face,
                                 std::span<const std::uint32_t> skipped = {});

}  // namespace hemitex::reference
