/// Rows of form factors between facets, each with an estimate of its error.
///
/// A hemicube sees well what is hidden, but it measures large near facets badly: the form factor changes along the
/// shooting facet, and edges alias. A closed form knows both, but not what is hidden. So the form factor from facet i
/// to facet j is
///
///     F_ij = v_ij U_ij,
///
/// where U is the closed form without blockers (quick_form_factor.h), and v the visible part: the light that reaches j
/// through the pixels of hemicubes over points of i, over the light through the pixels that j covers as if it were
/// alone (radiosity/projection/covered_share.h). Both sums have the same points and pixels, so that most errors of the
/// hemicubes cancel. A facet that covers very few pixels keeps the light through its pixels.
///
/// The points are centroids of equal parts of the facet, with more of them until the estimated error is small enough.
/// The estimate compares two sets of points: each visible part is measured twice, and the row's error is twice the sum
/// of the differences, and a little more than a pixel. At the end the shares are changed by their errors so that they
/// sum to 1.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "reference/matrices/sparse_row.h"
#include "reference/truth/closed_forms/merged_pieces.h"

namespace hemitex::reference {

struct FacetRowSettings {
  double maxError =
      0.01;  ///< of a row: points are added until the estimate is below, at most 400 per triangle; above 0
};

class FacetFormFactors {
 public:
  /// Facet f is surface f, planar and unburied. The scene must outlive this object.
  FacetFormFactors(const radiosity::Scene& scene, const FacetRowSettings& settings);
  ~FacetFormFactors();

  /// The row of a facet, whose receivers are all facets. Errors of entries are rounded to binary32, and none is small
  /// by chance. The error of the row is estimated by the differences of both halves, and what facets smaller than a
  /// pixel may receive. May be called by several threads; the result does not depend on them.
  SparseRow row(std::uint32_t facet);

 private:
  class Worker;
  const radiosity::Scene& scene_;
  FacetRowSettings settings_;
  std::vector<ConvexPolygons> polygons_;  ///< of each facet
  radiosity::Discretization images_;  ///< elements are the facets at all instances, numbered instance by instance
  radiosity::IdLayout layout_;        ///< item IDs are the numbers of these elements
  std::mutex mutex_;
  std::vector<std::unique_ptr<Worker>> idle_;
};

}  // namespace hemitex::reference
