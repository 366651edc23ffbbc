/// Sums item buffers to form-factor rows: maps item IDs to elements and runs of pixels to shares. Time and memory are
/// bounded by the number of pixels, not by the number of elements.
///
/// A run is a sequence of adjacent pixels with the same item ID. Its share is the difference of two running sums of
/// delta form factors, so that long runs are cheap. Runs are looked up and added about a thousand at a time, so that
/// the cache misses of tables with an entry per element overlap. Threads sum parts of the buffers separately. Shares
/// are integers, so that the distribution over threads does not change the result.
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/id_lookup.h"
#include "radiosity/form_factors/sparse_sums.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/projection/projection.h"
#include "raster/base/pool.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

/// Adds the buffer of a window of a projection's face. May be called by several threads at a time.
using AddWindow = std::function<void(const Window& window, const raster::ItemBuffer& buffer)>;

class ItemBufferSum {
 public:
  /// Both referenced objects must outlive this one.
  ItemBufferSum(const Discretization& discretization, const IdLayout& layout);

  /// The sum of the windows that `draw` draws, the complete row if they are wholeFaces. `draw` adds each as soon as it
  /// is complete. Item IDs in a window do not depend on the scissor rectangle that was drawn.
  FormFactorRow rowOf(const Projection& projection, const std::function<void(const AddWindow& add)>& draw);
  /// As above for windows that are drawn, with one buffer per window.
  FormFactorRow rowOf(const Projection& projection, std::span<const Window> windows,
                      std::span<const raster::ItemBuffer> buffers);

  /// The row of sums by the slots of `table`.
  FormFactorRow rowOf(raster::SlotSums sums) const;
  raster::SlotTable table() const { return slots_.table(); }

  /// Memory in addition to the discretization and the layout.
  std::size_t bytes() const;

 private:
  void add(const Projection& projection, const Window& window, const raster::ItemBuffer& buffer);

  IdLookup slots_;
  raster::Pool<SparseSums> sums_;  ///< all 0 between rows
};

}  // namespace hemitex::radiosity
