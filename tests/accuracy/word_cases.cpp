#include "tests/accuracy/word_cases.h"

#include <algorithm>

#include "radiosity/index_maps/id_layout.h"
#include "raster/base/input_error.h"

namespace hemitex::accuracy {
namespace {

using namespace radiosity;
using raster::Word;

/// The texels of a surface of 2^k, as a grid near to a square.
Grid gridOf(int indexBits) {
  Grid grid;
  grid.columns = 1 << (indexBits - indexBits / 2);
  grid.rows = 1 << (indexBits / 2);
  return grid;
}

/// Surfaces that fill a format's words to the last. The last surface is a strip, two texels short or not.
Discretization filled(const WordCase& example, bool isShort) {
  Discretization discretization;
  discretization.grids.assign(example.surfaces - 1, gridOf(example.indexBits));
  Grid last;
  last.columns = static_cast<int>((std::int64_t{1} << example.indexBits) - (isShort ? 2 : 1));
  if (last.columns > 0) discretization.grids.push_back(last);
  return discretization;
}

WordLayout layoutOf(const WordCase& example, bool isShort) {
  return layOut(filled(example, isShort), {example.format, raster::Blend::ClampedAdd, true});
}

std::string refusalOf(const WordCase& example) {
  try {
    layoutOf(example, false);
  } catch (const raster::InputError& error) {
    return error.what();
  }
  return {};
}

}  // namespace

std::vector<WordCase> wordCases() {
  std::vector<WordCase> cases;
  for (int k = 1; k <= 31; ++k) {
    const auto [format, bits] = k < 16   ? std::pair("r5g6b5", 16)
                                : k < 24 ? std::pair("r8g8b8", 24)
                                         : std::pair("r8g8b8a8", 32);
    cases.push_back({k, format, std::uint64_t{1} << (bits - k), {}});
    cases.back().refusal = refusalOf(cases.back());
  }
  return cases;
}

bool isOneToOne(const WordCase& example) {
  const Discretization discretization = filled(example, true);
  const WordLayout layout = layoutOf(example, true);
  const Word background = raster::backgroundWord(layout.format);
  const auto standsFor = [&](std::uint32_t surface, Word texel) {
    const Word word = raster::blend(layout.format, layout.blend, layout.pages[surface].offset, texel);
    const auto found = pageIndexOf(layout, word);
    return word == layout.pages[surface].offset + texel && word < background - 1 && found && found->page == surface &&
           found->index == texel;
  };
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    const Grid& grid = discretization.grids[s];
    const Word texels = static_cast<Word>(grid.columns) * static_cast<Word>(grid.rows);
    for (const Word texel : {Word{0}, texels / 3, texels - 1})
      if (!standsFor(s, texel)) return false;
  }
  return layout.indexBits == std::max(1, example.indexBits) && !pageIndexOf(layout, background) &&
         !pageIndexOf(layout, background - 1);
}

}  // namespace hemitex::accuracy
