/// The rows along which a solution shoots, whatever their source, and what it says of rows that it will need. The
/// README of this folder lists the sources.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/patch_subdivision.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// A patch that will probably shoot soon, and its weight (see PatchSplit) if it shot now.
struct LikelyShot {
  std::uint32_t patch = 0;
  double weight = 0;
};

/// What a solution will probably shoot next.
struct NextShots {
  const Patches& patches;
  /// Likely shots, the one with the most flux first: at most `count`, without those whose rows are in the cache.
  std::function<std::vector<LikelyShot>(std::size_t count)> likely;
};

/// The rows of a solution, and the patches that they are of.
struct PatchRows {
  RowSource rowOf;
  PatchSplit split = {};  ///< without it no patch is split
  double captured = 1;    ///< share of a patch's light that rows hold; the rest is lost
  std::function<void(const NextShots& next)> prepare = {};  ///< called between shots: computes rows of likely ones
};

/// Gives other rows than those that are drawn, or goes around these. The arguments outlive the rows.
using OtherRows = std::function<PatchRows(PatchRows drawn, const Scene& scene, const Discretization& discretization)>;

}  // namespace hemitex::radiosity
