/// The text of tests/builds/one_answer/vector_suite.txt.
#pragma once

#include <algorithm>
#include <iterator>
#include <span>
#include <string>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::tests {

/// A line `hash name` per vector, in order, and a last line `hash suite` over the item IDs of all vectors.
inline std::string suiteHashes(std::span<const reference::TestVector> suite) {
  std::string lines;
  std::vector<raster::ItemBuffer> all;
  for (const reference::TestVector& vector : suite) {
    std::vector<raster::ItemBuffer> buffers = render(vector);
    lines += reference::idsHash(buffers) + " " + vector.name + "\n";
    std::move(buffers.begin(), buffers.end(), std::back_inserter(all));
  }
  return lines + reference::idsHash(all) + " suite\n";
}

}  // namespace hemitex::tests
