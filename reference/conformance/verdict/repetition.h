/// Whether a device draws the same item IDs each time. A device that does not is wrong even where each of its answers
/// is within its profile.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// A pixel whose item ID was not always that of the first run.
struct ChangingPixel {
  std::string face;
  int column, row;     ///< in the viewport
  std::uint64_t runs;  ///< in which it differed
};

struct Repetition {
  std::uint64_t runs = 0;
  std::vector<std::uint64_t> answers;  ///< number of runs with the same item IDs, in the order of first appearance
  std::vector<ChangingPixel> pixels;   ///< face by face and row by row

  bool isDeterministic() const { return answers.size() <= 1; }
};

/// Collects the item IDs of several runs. Memory: one answer, and a count per pixel.
class RepeatedRuns {
 public:
  /// The vector must outlive this object.
  explicit RepeatedRuns(const TestVector& vector) : vector_(vector) {}

  /// One item buffer per face, of its size.
  void add(std::span<const raster::ItemBuffer> buffers);
  Repetition result() const;

 private:
  const TestVector& vector_;
  std::vector<raster::ItemBuffer> first_;
  std::vector<std::vector<std::uint64_t>> differing_;  ///< runs, per face and pixel
  std::vector<std::string> hashes_;                    ///< of the different answers
  std::vector<std::uint64_t> answers_;
};

/// "10 of 1000 runs differ from the most frequent item IDs, at 12 pixels: first top (3, 4)". Requires changing pixels.
std::string toText(const Repetition& repetition);

}  // namespace hemitex::reference
