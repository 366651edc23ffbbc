/// Splitting patches whose light would go elsewhere from other points of them.
///
/// A hemicube sees from one point, and shoots for the whole patch as if all of it were there. That is right where the
/// patch is small for its distance. Between two parallel squares a side apart it is 20 % too much, at half a side 33 %
/// (the cases of Baum, Rushmeier and Winget 1989). So a patch is quartered while too much of its light is misdirected.
///
/// How much that is, its own row says. With A the areas, F_ij A_i / A_j is by reciprocity F_ji, the share of what patch
/// j sends out that reaches i, so
///
///     sum_j F_ij min(1, F_ij A_i / A_j)
///
/// is the share of its light that would come straight back to patch i from white surroundings. It says how large the
/// patch is to those that it lights, weighted by how much each of them gets; and so does the error of shooting from one
/// point. Light that backs absorb counts as coming back: it shows that the point is among faces that turn away, which
/// other points of the patch may not see. One low hemicube is enough to find both. Where a patch goes round a fold, the
/// share by which its normals cancel is added.
///
/// A patch is looked at when it is about to shoot for the first time, with the flux that it has then. Its weight is
/// this flux over a 256th of all emitted flux. Error is flux times misdirected share, and either falls to a quarter
/// where a patch is quartered, so that work is best spent where the share is in proportion to the root of the weight:
/// the limit of a patch of weight w is that of the settings over sqrt(w). Likewise faint patches are drawn at lower
/// resolutions.
///
/// Each part shoots the light of its own elements. One cannot be cut, so a patch of one shoots from several points
/// at once.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// The share of a patch's light that may be misdirected unless something else is asked for. The error of all light is
/// then about 0.3 % in the plain rooms of data/, and 0.65 % in the furnished one (docs/light.md).
inline constexpr double defaultMaxMisdirected = 0.003;
/// No side is halved more often than this.
inline constexpr int maxSplits = 4;
/// No resolution is halved more often than this.
inline constexpr int maxHalvings = 8;

/// Splits patches of one discretization, which changes: elements stay what they are.
class PatchSubdivision {
 public:
  /// `layout` is that of the discretization; the renderer draws its draw list. All referenced objects must outlive this
  /// one. `maxMisdirected`: the share of its light that a patch of weight 1 may misdirect; 1 or more splits none.
  PatchSubdivision(const Scene& scene, Discretization& discretization, const IdLayout& layout,
                   raster::ItemBufferRenderer& renderer, double maxMisdirected);

  /// Quarters a patch until no more than maxMisdirected / sqrt(weight) of the light of each part is misdirected, the
  /// weight of a part being that of the patch times its share of the area. Returns the numbers of the new patches. A
  /// patch that was looked at before, or is a part of one, stays as it is.
  std::vector<std::uint32_t> split(std::uint32_t patch, double weight);

 private:
  struct Part;

  void split(Part part, double weight, std::vector<Part>& parts);
  double misdirectedShareOf(const Part& part);
  double foldOf(const Part& part) const;
  double returningShareOf(const FormFactorRow& row, double area);
  double areaOf(const Part& part) const;
  int leafSideOf(const Part& part) const;
  std::vector<Part> quarters(const Part& part) const;
  std::vector<std::uint32_t> replace(std::uint32_t patch, const std::vector<Part>& parts);

  const Scene& scene_;
  Discretization& discretization_;
  ProjectedFormFactors rows_;
  std::vector<double> patchArea_;     ///< one a patch
  std::vector<std::uint64_t> share_;  ///< one a patch, all 0 between rows
  double maxMisdirected_;
};

/// The discretization with every patch split as if it had weight 1.
Discretization splitPatches(const Scene& scene, Discretization discretization, const IdLayout& layout,
                            raster::ItemBufferRenderer& renderer, double maxMisdirected);

}  // namespace hemitex::radiosity
