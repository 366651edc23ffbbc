#include "radiosity/word_layout.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <numeric>
#include <string>

#include "raster/input_error.h"

namespace hemitex::radiosity {
namespace {

using raster::InputError;
using raster::Word;
using raster::WordFormat;

std::uint64_t texelCount(const Grid& grid) {
  return static_cast<std::uint64_t>(grid.columns) * static_cast<std::uint64_t>(grid.rows);
}

/// The words that draws may produce: all but the two reserved ones.
std::uint64_t capacity(const WordFormat& format) { return std::uint64_t{raster::backWord(format)}; }

std::string listedNames() {
  std::string names;
  for (const std::string& name : raster::formatNames()) names += (names.empty() ? "" : ", ") + name;
  return names;
}

/// Offsets in 64 bits, so that they can be told to be too large.
struct Offsets {
  std::vector<std::uint64_t> offset;  ///< one a surface
  std::uint64_t words = 0;            ///< the end of the last surface
};

Offsets alignedOffsets(const Discretization& discretization, int indexBits, std::uint64_t textured) {
  Offsets offsets;
  std::uint64_t nextTextured = 0, nextSingle = textured << indexBits;
  for (const Grid& grid : discretization.grids) {
    offsets.offset.push_back(isDiscretized(grid) ? nextTextured++ << indexBits : nextSingle++);
    offsets.words = std::max(offsets.words, offsets.offset.back() + texelCount(grid));
  }
  return offsets;
}

Offsets packedOffsets(const Discretization& discretization) {
  Offsets offsets;
  for (const Grid& grid : discretization.grids) {
    offsets.offset.push_back(offsets.words);
    offsets.words += texelCount(grid);
  }
  return offsets;
}

/// The words that `textured` surfaces of texels x texels and `singles` of one take.
std::uint64_t wordsNeeded(std::uint64_t textured, std::uint64_t singles, std::uint64_t texels, bool aligned) {
  const std::uint64_t indices = texels * texels;
  if (!aligned || textured == 0 || indices == 1) return textured * indices + singles;
  const std::uint64_t block = std::bit_ceil(indices);
  return singles > 0 ? textured * block + singles : (textured - 1) * block + indices;
}

/// The narrowest format with so many words; empty where there is none.
std::string formatAdvice(std::uint64_t words) {
  for (const std::string& name : raster::formatNames())
    if (words <= capacity(*raster::formatNamed(name))) return "use the format " + name;
  return {};
}

/// The number of texels along a side that would fit; empty where not even one does.
std::string texelAdvice(const WordLayout& layout) {
  const std::uint64_t singles = layout.byOffset.size() - layout.textured;
  const auto fits = [&](std::uint64_t texels) {
    return wordsNeeded(layout.textured, singles, texels, layout.aligned) <= capacity(layout.format);
  };
  std::uint64_t texels = 4096;
  while (texels > 0 && !fits(texels)) --texels;
  const std::string side = std::to_string(texels);
  return texels > 0 ? "give a surface " + side + " x " + side + " texels at most" : "";
}

[[noreturn]] void throwTooLarge(const WordLayout& layout, std::string_view formatName, std::uint64_t words) {
  const std::string format = formatAdvice(words), texels = texelAdvice(layout);
  const std::string advice = format + (format.empty() || texels.empty() ? "" : ", or ") + texels;
  throw InputError("the scene needs " + std::to_string(words) + " words, but " + std::string(formatName) + " has " +
                       std::to_string(capacity(layout.format)) + " of use",
                   advice.empty() ? "no format has as many: use fewer surfaces" : advice);
}

}  // namespace

WordLayout layOut(const Discretization& discretization, std::string_view formatName, raster::Blend blend,
                  bool aligned) {
  assert(blend != raster::Blend::Replace);
  const std::optional<WordFormat> format = raster::formatNamed(formatName);
  if (!format)
    throw InputError("'" + std::string(formatName) + "' is not a word format", "the formats are " + listedNames());
  WordLayout layout{*format, blend, aligned, 0, {}, {}, 0};
  for (const Grid& grid : discretization.grids) {
    layout.textured += isDiscretized(grid) ? 1 : 0;
    layout.indexBits = std::max(layout.indexBits, static_cast<int>(std::bit_width(texelCount(grid) - 1)));
  }
  layout.byOffset.resize(discretization.grids.size());
  std::iota(layout.byOffset.begin(), layout.byOffset.end(), 0u);
  const auto isTextured = [&](std::uint32_t surface) { return isDiscretized(discretization.grids[surface]); };
  if (aligned) std::stable_partition(layout.byOffset.begin(), layout.byOffset.end(), isTextured);
  const Offsets offsets =
      aligned ? alignedOffsets(discretization, layout.indexBits, layout.textured) : packedOffsets(discretization);
  if (offsets.words > capacity(layout.format)) throwTooLarge(layout, formatName, offsets.words);
  for (const std::uint64_t offset : offsets.offset) layout.offset.push_back(static_cast<Word>(offset));
  return layout;
}

Phantoms countPhantoms(const Discretization& discretization, const WordLayout& layout) {
  Phantoms phantoms;
  for (const Grid& grid : discretization.grids) {
    if (!isDiscretized(grid)) continue;
    phantoms.spareTexels += grid.phantoms;
    if (layout.aligned) phantoms.alignmentGaps += (std::uint64_t{1} << layout.indexBits) - texelCount(grid);
  }
  return phantoms;
}

std::optional<SurfaceTexel> texelOf(const Discretization& discretization, const WordLayout& layout, Word word) {
  std::uint32_t surface = 0;
  if (!layout.aligned) {
    const auto next = std::upper_bound(layout.byOffset.begin(), layout.byOffset.end(), word,
                                       [&](Word w, std::uint32_t s) { return w < layout.offset[s]; });
    if (next == layout.byOffset.begin()) return std::nullopt;
    surface = *(next - 1);
  } else if (const Word block = word >> layout.indexBits; block < layout.textured) {
    surface = layout.byOffset[block];
  } else {
    const std::uint64_t place = word - (std::uint64_t{layout.textured} << layout.indexBits) + layout.textured;
    if (place >= layout.byOffset.size()) return std::nullopt;
    surface = layout.byOffset[place];
  }
  const Word texel = word - layout.offset[surface];
  if (texel >= texelCount(discretization.grids[surface])) return std::nullopt;
  return SurfaceTexel{surface, texel};
}

}  // namespace hemitex::radiosity
