/// Baseline without geometry: a lower bound on the time of a hemicube. It clears buffers, in parts that stay in the
/// cache. Then it reads the item IDs of a drawn patch once and sums the row by runs of equal item IDs, with one
/// comparison per pixel (radiosity/form_factors/item_buffer_sum.h).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/item_buffer_sum.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/projection/projection.h"
#include "raster/base/per_thread.h"
#include "raster/interface/face.h"

namespace hemitex::reference {

/// Bytes per pixel that the reference renderer clears besides the item ID: depth and visible triangle.
inline constexpr std::size_t fragmentBytes = 12;

class BenchFloor {
 public:
  /// All arguments must outlive this object.
  BenchFloor(const radiosity::Discretization& discretization, const radiosity::IdLayout& layout,
             const radiosity::Projection& projection);

  /// Clears as many bytes as drawing the faces of the projection, then sums the row of item IDs drawn before, one item
  /// buffer per face. Returns the row without the light that the projection does not capture.
  radiosity::FormFactorRow row(std::span<const raster::ItemBuffer> ids);

 private:
  const radiosity::Projection& projection_;
  std::vector<radiosity::Window> faces_;
  radiosity::ItemBufferSum counter_;
  std::vector<raster::ItemId> cleared_;  ///< of all faces
  raster::PerThread<std::vector<std::byte>> fragments_;
};

}  // namespace hemitex::reference
