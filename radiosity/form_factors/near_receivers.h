/// Form factors from patches to small elements beside them, by reciprocity.
///
/// A patch shoots from one point. An element that is small and near, such as the edge of a rug on the floor, receives
/// most of its light from the part of the patch beside it. The point of the patch is farther away and does not
/// represent that part. From the element the patch is large: a hemicube over the centre of the element shows all of it.
/// Let A be areas. Then the form factor F_pe from patch p to element e follows from F_ep (reciprocity):
///
///     F_pe = F_ep A_e / A_p.
///
/// It replaces the share of the element in the row of the patch if F_ep is at least `nearShare`, and if the area that
/// each point of the patch shoots for is not smaller than the element. The row is then scaled so that it sums to 1
/// again. So the account of the flux stays closed.
///
/// The radiosity of the patch is that of its elements. Where radiosity changes within an element beside the small one,
/// as in a dark corner, the error of that remains.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// The smallest form factor from an element to a patch near it.
inline constexpr double nearShare = 1.0 / 32;

/// What a solution has found of small elements. Another scene, after an edit, takes over what is still right.
struct NearRows {
  enum class State : std::uint8_t { Unknown, Drawn, Corrected };

  std::map<std::uint32_t, FormFactorRow> ofElements;  ///< rows of small elements, drawn on demand
  std::vector<State> ofPatches;                       ///< their rows, by patch; further ones are unknown

  State of(std::uint32_t patch) const { return patch < ofPatches.size() ? ofPatches[patch] : State::Unknown; }
  void set(std::uint32_t patch, State state) {
    if (patch >= ofPatches.size()) ofPatches.resize(patch + std::size_t{1});
    ofPatches[patch] = state;
  }
};

/// The distance from the centre of a patch, in units of the scene, beyond which no element is near it: F_ep is at most
/// A_p / (pi d^2) at the distance d of the patch. Twice that, because patches may be up to 40 times as long as wide.
double nearDistanceOf(const Patch& patch);

class NearReceivers {
 public:
  /// `layout` is that of the discretization; the renderer draws its draw list. All referenced objects must outlive this
  /// one. Small elements have at most half of the mean area. In scenes with many of them, or with many triangles, only
  /// the smallest count, because each needs a hemicube.
  NearReceivers(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                raster::ItemBufferRenderer& renderer);

  /// The row that was drawn for a patch with the shares of small elements near it replaced; nothing if there are none.
  std::optional<FormFactorRow> corrected(const Patch& patch, const FormFactorRow& row);

  bool isSmall(std::uint32_t element) const { return isSmall_[element]; }
  /// The view from a small element.
  View viewFrom(std::uint32_t element);
  NearRows& known() { return known_; }

 private:
  double factorTo(const Patch& patch, std::uint32_t element);

  const Scene& scene_;
  const Discretization& discretization_;
  ProjectedFormFactors rows_;
  std::vector<bool> isSmall_;  ///< one per element
  NearRows known_;
};

}  // namespace hemitex::radiosity
