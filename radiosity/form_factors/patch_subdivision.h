/// Splits patches for which shooting from one point is too inaccurate.
///
/// A hemicube samples one point and shoots for the whole patch from there. That is accurate if the patch is small
/// compared with its distance. Between two parallel squares one side apart the form factor is 20 % too large. At half a
/// side it is 33 % too large (Baum, Rushmeier and Winget 1989). So a patch is quartered while too much of its light is
/// misdirected.
///
/// The patch's own row gives an estimate. Let A be areas. By reciprocity, F_ij A_i / A_j is F_ji, the share of the
/// light of patch j that reaches patch i. Then
///
///     sum_j F_ij min(1, F_ij A_i / A_j)
///
/// is the share of the patch's light that white surroundings would reflect straight back to patch i. It measures the
/// size of the patch as seen by its receivers, weighted by the light they receive. The error of shooting from one point
/// depends on the same quantity. Light absorbed by backs also counts. It shows that the point is close to back faces,
/// which other points of the patch may not see. One hemicube of low resolution is enough for both. For a patch across a
/// fold, the share by which its normals cancel is added.
///
/// A patch is tested when it is about to shoot for the first time. Its weight is its flux at that time over a 256th of
/// all emitted flux, of which light from outside counts in part (see OutsideFlux::counted). The error is flux times
/// misdirected share, and quartering the patch divides both by 4. So work is distributed best if the limit of the share
/// is proportional to 1 / sqrt(weight): it is `maxMisdirected` / sqrt(w) for weight w. In the same way, faint patches
/// are drawn at lower resolutions.
///
/// Each part shoots the light of its own elements. An element cannot be split, so a patch of one element shoots from
/// several points instead.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// Default of the share of a patch's light that may be misdirected. The error of all light is then about 0.3 % in the
/// simple rooms of data/, and 0.65 % in the furnished room (docs/light.md).
inline constexpr double defaultMaxMisdirected = 0.003;
/// Maximum number of times that a side is halved.
inline constexpr int maxSplits = 4;
/// Maximum number of times that a resolution is halved.
inline constexpr int maxHalvings = 8;

/// Number of halvings of the resolution, 0 to maxHalvings, for a patch of this weight that is not split.
int halvingsFor(double weight);

/// The parts that replace a patch before its first shot (see replacePatch); one part if one point is enough. `weight`
/// is its unshot flux over a 256th of all emitted flux, or 256 times what it adds to the seen light (see SeenLight).
using PatchSplit = std::function<std::vector<Patch>(const Patches& patches, const Patch& patch, double weight)>;

/// Finds the parts of patches; elements stay the same.
class PatchSubdivision {
 public:
  /// `layout` is that of the discretization; the renderer draws its draw list. All referenced objects must outlive this
  /// one. `maxMisdirected` is the share of its light that a patch of weight 1 may misdirect, below 1.
  PatchSubdivision(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                   raster::ItemBufferRenderer& renderer, double maxMisdirected);

  /// Quarters a patch until each part misdirects at most maxMisdirected / sqrt(weight) of its light. The weight of a
  /// part is that of the patch times its share of the area. Returns the parts, which are settled.
  std::vector<Patch> split(const Patches& patches, const Patch& patch, double weight);
  /// The row of low resolution from the middle of the patch. Keeps it for a later call of `split`, which invalidates
  /// the reference.
  const FormFactorRow& scoutRow(const Patch& patch);
  /// Whether the patch would be split now. Keeps what it draws for a later call of `split`.
  bool wouldSplit(const Patches& patches, const Patch& patch, double weight);

 private:
  struct Part;

  void split(const Patches& patches, Part part, double weight, std::vector<Patch>& parts);
  double misdirectedShareOf(const Patches& patches, const Part& part);
  FormFactorRow estimatingRow(const Patch& block);
  double foldOf(const Patch& block) const;
  double returningShareOf(const Patches& patches, const FormFactorRow& row, double area);
  int leafSideOf(const Patch& block) const;
  std::vector<Part> quarters(const Part& part) const;

  const Scene& scene_;
  const Discretization& discretization_;
  ProjectedFormFactors rows_;
  std::vector<std::uint64_t> share_;                  ///< one per patch, all 0 between rows
  std::map<std::uint32_t, FormFactorRow> rowsAhead_;  ///< of patches that `wouldSplit` tested, by their first elements
  double maxMisdirected_;
};

}  // namespace hemitex::radiosity
