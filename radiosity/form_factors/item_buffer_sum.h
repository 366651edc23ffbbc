/// Sums item buffers to form-factor rows: maps item IDs to elements and runs of pixels to shares. Time and memory are
/// bounded by the number of pixels, not by the number of elements.
///
/// A run is a sequence of adjacent pixels with the same item ID. Its share is the difference of two running sums of
/// delta form factors, so that long runs are cheap. Runs are looked up and added about a thousand at a time, so that
/// the cache misses of tables with an entry per element overlap. Each thread sums parts of the buffers separately.
/// Shares are integers, so that the distribution over threads does not change the result.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/id_lookup.h"
#include "radiosity/form_factors/sparse_sums.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/projection/projection.h"
#include "raster/base/per_thread.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

class ItemBufferSum {
 public:
  /// Both referenced objects must outlive this one.
  ItemBufferSum(const Discretization& discretization, const IdLayout& layout);

  /// Adds a window of a projection's face. Item IDs in a window do not depend on the scissor rectangle that was drawn.
  /// May be called by several threads at a time.
  void add(const Projection& projection, const Window& window, const raster::ItemBuffer& buffer);
  /// Returns the sum of the windows added since the last call and resets it. If these are wholeFaces, that is the
  /// complete row.
  FormFactorRow takeRow();

  /// The row of these windows, with one buffer per window.
  FormFactorRow rowOf(const Projection& projection, std::span<const Window> windows,
                      std::span<const raster::ItemBuffer> buffers);

  /// Memory in addition to the discretization and the layout.
  std::size_t bytes() const;

 private:
  IdLookup slots_;
  raster::PerThread<SparseSums> sums_;
};

}  // namespace hemitex::radiosity
