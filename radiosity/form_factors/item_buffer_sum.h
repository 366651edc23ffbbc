/// Sums item buffers into rows: item IDs become elements, runs of pixels shares. What it costs is bounded by the
/// pixels, not by the elements of the scene.
///
/// Pixels that lie side by side and show one item ID are a run, which takes the difference of two running sums of delta
/// form factors: long runs cost next to nothing. Threads sum parts of the buffers, each for itself; shares are
/// integers, so that it does not matter which of them got which part.
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

  /// Adds what a window of a projection's face shows; drawing a face with a smaller scissor rectangle gives the same
  /// item IDs there. Windows may be added by several threads at a time.
  void add(const Projection& projection, const Window& window, const raster::ItemBuffer& buffer);
  /// What the windows that were added since the last row add up to: the whole row, where they are wholeFaces.
  FormFactorRow takeRow();

  /// The row of these windows, a buffer each.
  FormFactorRow rowOf(const Projection& projection, std::span<const Window> windows,
                      std::span<const raster::ItemBuffer> buffers);

  /// What it takes beside the discretization and the layout.
  std::size_t bytes() const;

 private:
  IdLookup slots_;
  raster::PerThread<SparseSums> sums_;
};

}  // namespace hemitex::radiosity
