#include "reference/conformance/verdict/repetition.h"

#include <algorithm>
#include <cassert>

namespace hemitex::reference {

void RepeatedRuns::add(std::span<const raster::ItemBuffer> buffers) {
  assert(buffers.size() == vector_.faces.size());
  if (first_.empty()) {
    first_.assign(buffers.begin(), buffers.end());
    for (const raster::ItemBuffer& buffer : buffers) differing_.emplace_back(buffer.ids.size(), 0);
  }
  for (std::size_t f = 0; f < buffers.size(); ++f)
    for (std::size_t pixel = 0; pixel < buffers[f].ids.size(); ++pixel)
      differing_[f][pixel] += buffers[f].ids[pixel] != first_[f].ids[pixel];
  const std::string hash = idsHash(buffers);
  const auto place = std::find(hashes_.begin(), hashes_.end(), hash);
  if (place == hashes_.end()) {
    hashes_.push_back(hash);
    answers_.push_back(1);
  } else {
    ++answers_[static_cast<std::size_t>(place - hashes_.begin())];
  }
}

Repetition RepeatedRuns::result() const {
  Repetition result{0, answers_, {}};
  for (const std::uint64_t runs : answers_) result.runs += runs;
  for (std::size_t f = 0; f < differing_.size(); ++f) {
    const VectorFace& face = vector_.faces[f];
    for (std::size_t pixel = 0; pixel < differing_[f].size(); ++pixel) {
      const glm::ivec2 at = pixelAt(face.face.scissor, pixel);
      if (differing_[f][pixel] > 0) result.pixels.push_back({face.name, at.x, at.y, differing_[f][pixel]});
    }
  }
  return result;
}

std::string toText(const Repetition& repetition) {
  const std::uint64_t maxRuns = *std::max_element(repetition.answers.begin(), repetition.answers.end());
  const ChangingPixel& first = repetition.pixels.front();
  return std::to_string(repetition.runs - maxRuns) + " of " + std::to_string(repetition.runs) +
         " runs differ from the most frequent item IDs, at " + std::to_string(repetition.pixels.size()) +
         " pixels: first " + first.face + " (" + std::to_string(first.column) + ", " + std::to_string(first.row) + ")";
}

}  // namespace hemitex::reference
