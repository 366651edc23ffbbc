/// What the judge of matrices takes beside a matrix: the mesh, and how much it measures.
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// The facets of a mesh: surfaces of one element each (see facet_form_factors.h).
struct FacetMesh {
  const radiosity::Scene& scene;
  const radiosity::Discretization& discretization;
  std::vector<std::uint32_t> facetOf;  ///< of each surface; ascending
  std::size_t facets = 0;              ///< also those without area, which have no surface
  /// Facets that have no surface because they repeat another, corner for corner, and the other one.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> repeated = {};
};

struct JudgeSettings {
  double tolerance = 0.05;  ///< relative error of an entry that is no fault, >= 0
  int rows = 32;            ///< that are measured by rays; at least 1
  int samples = 1 << 18;    ///< rays per row, at least 64
};

}  // namespace hemitex::reference
