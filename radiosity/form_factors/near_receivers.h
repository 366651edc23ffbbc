/// Form factors from patches to elements near them, by closed forms.
///
/// A patch shoots from points. An element that is near compared with the part of the patch that one point shoots for
/// receives its light from the part beside it, which the point does not represent: the wall beside a strip of light,
/// the edge of a rug on the floor. The form factor from point to polygon is a closed form. The mean over points of the
/// smaller of the two, times the share of rays that nothing blocks, replaces the share in the row of the patch
/// (surface_part.h) if the element
///
/// - is near a patch that emits light, or
/// - is smaller than the area that each point of the patch shoots for and at most half of the mean element, and its own
///   form factor to the patch is at least `nearShare`.
///
/// All other shares of the row are then scaled so that it sums to 1 again, and the account of the flux stays closed.
///
/// The radiosity of the patch is that of its elements. Where radiosity changes within an element beside the small one,
/// as in a dark corner, the error of that remains.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/element_materials.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/surface_part.h"
#include "radiosity/scene/ray_tree.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The smallest form factor from a small element to a patch near it.
inline constexpr double nearShare = 1.0 / 32;

/// Which rows of patches a solution has corrected.
struct NearRows {
  enum class State : std::uint8_t { Unknown, Drawn, Corrected };

  std::vector<State> ofPatches;  ///< by patch; further ones are unknown

  State of(std::uint32_t patch) const { return patch < ofPatches.size() ? ofPatches[patch] : State::Unknown; }
  void set(std::uint32_t patch, State state) {
    if (patch >= ofPatches.size()) ofPatches.resize(patch + std::size_t{1});
    ofPatches[patch] = state;
  }
};

class NearReceivers {
 public:
  /// All referenced objects must outlive this one.
  NearReceivers(const Scene& scene, const Discretization& discretization);

  /// The row that was drawn for a patch with the shares of elements near it replaced; nothing if there are none.
  std::optional<FormFactorRow> corrected(const Patch& patch, const FormFactorRow& row);

  bool isSmall(std::uint32_t element) const { return isSmall_[element]; }
  /// Whether a patch emits light.
  bool isLamp(const Patch& patch) const;
  /// The distance from the centre of a patch, in units of the scene, beyond which no element is near it.
  double distanceOf(const Patch& patch);
  NearRows& known() { return known_; }

 private:
  /// An entry of a row that may be replaced.
  struct Candidate {
    std::size_t entry = 0;
    const SurfacePart* part = nullptr;
    double least = 0;  ///< the smallest form factor from the element that counts
  };

  const SurfacePart& partOfElement(std::uint32_t element);
  std::vector<Candidate> candidates(const Patch& patch, const FormFactorRow& row,
                                    const std::vector<SurfacePart>& shapes);

  const Scene& scene_;
  const Discretization& discretization_;
  ElementMaterials materials_;
  bool areLampsSmall_ = false;                       ///< whether little of all area emits
  std::vector<bool> isSmall_;                        ///< one per element
  std::vector<Bounds> ofSurfaces_;                   ///< in the first instance
  std::optional<RayTree> tree_;                      ///< made on demand
  std::map<std::uint32_t, SurfacePart> ofElements_;  ///< made on demand
  NearRows known_;
};

}  // namespace hemitex::radiosity
