/// Rows of form factors between facets, each with an estimate of its error.
///
/// A hemicube sees well what is hidden, but it measures large near facets badly: the form factor changes along the
/// shooting facet, and edges alias. A closed form knows both, but not what is hidden. So the form factor from facet i
/// to facet j is
///
///     F_ij = v_ij U_ij,
///
/// where U is the closed form without blockers (quick_form_factor.h), and v the visible part. It is 1 where nothing can
/// lie between (free_shafts.h). Else it is the light that reaches j through the pixels of hemicubes over points of i,
/// over the light through the pixels that j covers as if it were alone (radiosity/projection/covered_share.h). Both
/// sums have the same points and pixels, so that most errors of the hemicubes cancel. A facet that covers very few
/// pixels keeps the light through its pixels, at most U.
///
/// The points of a triangle are random, one in each of its 4^k equal parts, or two of them in different quarters. Each
/// facet has points of its own, so that no edge lies between the points of all. Points in one part of the triangle tell
/// by their differences how uncertain the part is (collapsed strata: Cochran, Sampling Techniques, 1977, section
/// 5A.12), and with the differences of all points, how fast this falls from parts to their quarters. The surroundings
/// are what facets leave: the differences of the sum of all facets tell their error. Points are added until the
/// estimated error of the row is small enough. It has what chance may hide from the points, too. At the end the shares
/// are changed by their errors so that they sum to 1. No form factor is above U.
#pragma once

#include <cstdint>
#include <memory>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/base/pool.h"
#include "reference/matrices/sparse_row.h"
#include "reference/rows/free_shafts.h"

namespace hemitex::reference {

struct FacetRowSettings {
  double maxError =
      0.01;  ///< of a row: points are added until the estimate is below, at most 512 per triangle; above 0
};

class FacetFormFactors {
 public:
  /// Facet f is surface f, planar and unburied. The scene must outlive this object.
  FacetFormFactors(const radiosity::Scene& scene, const FacetRowSettings& settings);
  ~FacetFormFactors();

  /// The row of a facet, whose receivers are all facets. Errors of entries are rounded to binary32, and none is small
  /// by chance. The error of the row is that of all its shares, surroundings and backs among them. May be called by
  /// several threads; the result does not depend on them.
  SparseRow row(std::uint32_t facet);

 private:
  class Worker;
  const radiosity::Scene& scene_;
  FacetRowSettings settings_;
  FreeShafts shafts_;
  radiosity::Discretization images_;  ///< elements are the facets at all instances, numbered instance by instance
  radiosity::IdLayout layout_;        ///< item IDs are the numbers of these elements
  raster::Pool<std::unique_ptr<Worker>> workers_;  ///< null until the first use
};

}  // namespace hemitex::reference
