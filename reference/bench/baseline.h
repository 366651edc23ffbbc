/// The floor under the time of a hemicube: what is left where there is no geometry. Buffers are cleared, in parts that
/// stay in the cache, item IDs are read once, and a row is summed run by run
/// (radiosity/form_factors/item_buffer_sum.h): a pixel of a run costs a comparison.
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

/// What the reference renderer clears for a pixel beside its item ID: the depth and the triangle that it shows so far.
inline constexpr std::size_t fragmentBytes = 12;

class BenchFloor {
 public:
  /// All must outlive this one.
  BenchFloor(const radiosity::Discretization& discretization, const radiosity::IdLayout& layout,
             const radiosity::Projection& projection);

  /// Clears as much as drawing the projection's faces does, then sums the row of item IDs that were drawn before, an
  /// item buffer a face. The row that the item IDs stand for, without what the projection does not capture.
  radiosity::FormFactorRow row(std::span<const raster::ItemBuffer> ids);
  /// The same row, with nothing cleared before.
  radiosity::FormFactorRow sum(std::span<const raster::ItemBuffer> ids);

 private:
  const radiosity::Projection& projection_;
  std::vector<radiosity::Window> faces_;
  radiosity::ItemBufferSum counter_;
  std::vector<raster::ItemId> cleared_;  ///< of all faces
  raster::PerThread<std::vector<std::byte>> fragments_;
};

}  // namespace hemitex::reference
