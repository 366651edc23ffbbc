/// The methods whose speed and accuracy are compared: each finds the rows of patches, at one setting that says how much
/// it does. A new method is one more entry of the list.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/progressive_solver.h"

namespace hemitex::reference {

/// What finds rows, and splits patches on the way.
struct TradeRows {
  std::shared_ptr<const radiosity::Discretization> discretization;  ///< whose patches are split
  radiosity::RowSource rowOf;
  radiosity::PatchSplit split = {};
};

struct TradeMethod {
  std::string name;                       ///< one item ID, as on the command line
  std::string setting;                    ///< what its number is called; always a power of two
  int least, most;                        ///< of the numbers that it can be given
  std::vector<int> measured;              ///< the numbers that are compared where no others are asked for, ascending
  std::function<double(int)> directions;  ///< in which a row looks, at a setting: pixels or rays
  std::function<std::size_t(int)> bufferBytes;  ///< of item buffers, or of the rays of a row
  /// Ready to find the rows of the patches of a discretization. The scene must outlive it.
  std::function<TradeRows(const radiosity::Scene&, const radiosity::Discretization&, int)> rows;
};

/// - `hemicube`: from the centre of a patch, its setting the resolution.
/// - `turned-hemicube`: each turned about its normal by an angle of its own.
/// - `split-hemicube`: turned, and patches that are near to what they light are split (see
/// radiosity/form_factors/patch_subdivision.h).
/// - `single-plane`, `tetrahedron`: turned as well, on the faces of these projections (see
/// radiosity/projection/single_plane.h and radiosity/projection/cubic_tetrahedron.h).
/// - `levels-of-detail`: turned hemicubes, with coarser index maps where surfaces cover few pixels (see
/// radiosity/form_factors/level_of_detail.h).
/// - `centre-rays`: rays from the same points as hemicubes, so that what differs is how directions are looked into.
/// - `area-rays`: rays from all over a patch.
std::vector<TradeMethod> tradeMethods();

}  // namespace hemitex::reference
