/// Rows of patches that emit light, by what the elements see of them: direct light is gathered.
///
/// A hemicube over a lamp sees each element through a few pixels, and only from one point of the lamp. An element that
/// is seen through four pixels gets a quarter too much or too little. One that is near gets most of its light from the
/// part of the lamp beside it, which the point does not represent. Seen from the element, both are simple. Let A be
/// areas. Then the form factor F_pe from patch p to element e follows from F_ep (reciprocity):
///
///     F_pe = F_ep A_e / A_p,    F_ep = the closed form of the patch's polygon, times its visible share,
///
/// in the mean over points of the element. The closer the patch, the more points. Rays find the visible share, unless
/// nothing is between the patch and the elements around this one.
///
/// Blocks of elements get these shares that are drawn with half a pixel per element or more, on average. All shares are
/// then scaled by at most half a percent, so that the sum is as drawn; what leaves the scene or meets backs gets the
/// rest. If nothing does, the shares are scaled to 1. So the account of the flux stays closed.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/element_materials.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/patch_shape.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

class GatheredRows {
 public:
  /// `resolution` is that of projections. All referenced objects must outlive this one.
  GatheredRows(const Scene& scene, const Discretization& discretization, int resolution);

  /// Whether the rows of a patch are gathered: it emits light, the same everywhere, and is not so faint that it is
  /// drawn at a lower resolution.
  bool isGathered(const Patch& patch) const;
  /// The row that was drawn for such a patch with gathered shares.
  FormFactorRow gathered(const Patch& patch, const FormFactorRow& drawn);

 private:
  /// Elements in a square of texels.
  struct Block {
    std::vector<SeeingElement> elements;
    Bounds bounds = {};
    std::optional<Plane> plane = {};  ///< if all of them lie in it
  };
  /// A block whose shares are gathered, and the place of its surface's first element among them.
  struct Task {
    const Block* block;
    std::size_t first;
  };

  const std::vector<Block>& blocksOf(std::uint32_t surface);
  void gather(const Task& task, const std::vector<PatchShape>& shapes, std::vector<double>& shares) const;

  const Scene& scene_;
  const Discretization& discretization_;
  const ElementMaterials materials_;
  int resolution_;
  std::map<std::uint32_t, std::vector<Block>> blocks_;  ///< by surface, made on demand
  std::optional<RayTree> tree_;                         ///< made on demand
};

}  // namespace hemitex::radiosity
