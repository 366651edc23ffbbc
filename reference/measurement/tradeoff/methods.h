/// The methods that are compared in time and error. Each computes rows of patches and has one setting, its resolution
/// or number of rays. To add a method, add an entry to the list, and a line that
/// says what it is to cli/report/tradeoff.html.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "radiosity/light/light.h"

namespace hemitex::reference {

/// How a method computes rows.
struct TradeRows {
  radiosity::DrawingSettings drawing = {};
  decltype(radiosity::LightHooks::rows) others = {};  ///< see LightHooks; empty if rows are drawn
};

struct TradeMethod {
  std::string name;                             ///< as on the command line, without spaces
  std::string setting;                          ///< name of the setting, whose value is a power of two
  int smallest, largest;                        ///< range of the setting
  std::vector<int> measured;                    ///< default settings, ascending
  std::function<double(int)> directions;        ///< pixels or rays per row, for a setting
  std::function<std::size_t(int)> bufferBytes;  ///< bytes of item buffers, or of the rays of a row
  std::function<TradeRows(int)> rows;           ///< for a setting
};

/// All methods:
///
/// - `hemicube`: from the centre of a patch; the setting is the resolution.
/// - `turned-hemicube`: rotated per patch about its normal.
/// - `split-hemicube`: rotated per patch; patches near to their receivers are split (see
///   radiosity/form_factors/patch_subdivision.h).
/// - `single-plane`, `tetrahedron`: rotated per patch, with these projections (see
///   radiosity/projection/projection_kinds.h).
/// - `levels-of-detail`: rotated hemicubes with coarser index maps for surfaces that cover few pixels (see
///   radiosity/form_factors/level_of_detail.h).
/// - `centre-rays`: rays from the same points as hemicubes, to compare directions only.
/// - `area-rays`: rays from the whole area of a patch.
///
/// `seed` gives rays another sequence (see sample_points.h).
std::vector<TradeMethod> tradeMethods(std::uint32_t seed = 0);

}  // namespace hemitex::reference
