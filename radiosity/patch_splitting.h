/// Splitting patches that are near to what they light.
///
/// A hemicube sees from one point, and shoots for the whole patch as if all of it were there. That is right where the
/// patch is small for its distance. Between two parallel squares a side apart it is 20 % too much, at half a side 33 %
/// (the cases of Baum, Rushmeier and Winget 1989). So a patch is quartered while it is too near.
///
/// How near it is, its own row says. With A the areas, F_ij A_i / A_j is by reciprocity F_ji, the share of what patch j
/// sends out that reaches i, so
///
///     sum_j F_ij min(1, F_ij A_i / A_j)
///
/// is the share of its light that would come straight back to patch i from white surroundings. It says how large the
/// patch is to those that it lights, weighted by how much each of them gets; and so does the error of shooting from one
/// point. Light that backs absorb counts as coming back: it shows that the point is among faces that turn away, which
/// other points of the patch may not see. One low hemicube is enough to find both.
///
/// A patch is looked at when it is about to shoot for the first time, with the flux that it has then: the error is this
/// flux times the share that comes back, and a split is worth its cost where that is large.
///
/// Each part shoots the light of its own elements. One cannot be cut, so a patch of one shoots from several points
/// at once.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/projected_rows.h"
#include "radiosity/scene.h"
#include "radiosity/word_layout.h"
#include "raster/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// As much of its light as comes straight back to a patch unless something else is asked for. On the scenes of data/ an
/// error of 1 % takes no more, and further splits buy little.
inline constexpr double defaultMostReturning = 0.0125;
/// No side is halved more often than this.
inline constexpr int mostHalvings = 4;

/// Splits patches of one discretization, which changes: elements stay what they are.
class PatchSplitter {
 public:
  /// `layout` is that of the discretization; the renderer draws its draw list. All referenced objects must outlive this
  /// one. `mostReturning`: of the light of a patch of mean flux, what may come straight back; 1 or more splits none.
  PatchSplitter(const Scene& scene, Discretization& discretization, const WordLayout& layout,
                raster::ItemBufferRenderer& renderer, double mostReturning);

  /// Quarters a patch until no more than mostReturning / weight of the light of each part comes straight back, the
  /// weight of a part being that of the patch times its share of the area. Returns the numbers of the new patches. A
  /// patch that was looked at before, or is a part of one, stays as it is.
  std::vector<std::uint32_t> split(std::uint32_t patch, double weight);

 private:
  struct Part;

  void split(const Part& part, double weight, std::vector<Part>& parts);
  double returningShareOf(const Part& part, double area);
  double returningShareOf(const FormFactorRow& row, double area);
  double areaOf(const Part& part) const;
  int leafSideOf(const Part& part) const;
  std::vector<Part> quarters(const Part& part) const;
  std::vector<std::uint32_t> replace(std::uint32_t patch, const std::vector<Part>& parts);

  const Scene& scene_;
  Discretization& discretization_;
  ProjectedRows rows_;
  std::vector<double> patchArea_;     ///< one a patch
  std::vector<std::uint64_t> share_;  ///< one a patch, all 0 between rows
  double mostReturning_;
};

/// The discretization with every patch split as if all had the same flux.
Discretization splitPatches(const Scene& scene, Discretization discretization, const WordLayout& layout,
                            raster::ItemBufferRenderer& renderer, double mostReturning);

}  // namespace hemitex::radiosity
