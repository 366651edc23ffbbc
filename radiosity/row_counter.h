/// Counts item buffers into rows: words to elements through the layout and the spill tables, pixels to shares.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "radiosity/discretization.h"
#include "radiosity/form_factors.h"
#include "radiosity/projection.h"
#include "radiosity/word_layout.h"
#include "raster/face.h"

namespace hemitex::radiosity {

class RowCounter {
 public:
  /// Both referenced objects must outlive this one.
  RowCounter(const Discretization& discretization, const WordLayout& layout);

  /// Adds the words of a window of one of the projection's faces. It lies inside that face's scissor rectangle, and is
  /// all of it for a whole row; drawing a face with a smaller scissor rectangle gives the same words there.
  void add(const Projection& projection, std::size_t face, const raster::Scissor& window,
           const raster::ItemBuffer& buffer);

  /// What was added since the last time.
  FormFactorRow take();

 private:
  void add(raster::Word word, std::uint64_t share);

  const Discretization& discretization_;
  const WordLayout& layout_;
  FormFactorRow row_;                 ///< its elements in the order in which they were first seen, without shares
  std::vector<std::uint64_t> share_;  ///< one an element, all 0 between rows
};

}  // namespace hemitex::radiosity
