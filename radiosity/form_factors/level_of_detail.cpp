#include "radiosity/form_factors/level_of_detail.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

namespace hemitex::radiosity {
namespace {

/// The elements [first, end) of a row that belong to one surface.
struct Run {
  std::size_t first = 0, end = 0;
};

std::vector<Run> runsBySurface(const Discretization& discretization, const FormFactorRow& row) {
  std::vector<Run> runs;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const auto surfaceOf = [&](std::size_t k) { return discretization.elements[row.elements[k]].surface; };
    if (i == 0 || surfaceOf(i) != surfaceOf(i - 1)) runs.push_back({i, i});
    runs.back().end = i + 1;
  }
  return runs;
}

/// The block of a level that contains an element's own texel, by row and column of blocks.
using Block = std::pair<int, int>;

Block blockOf(const Grid& grid, const Element& element, int level) {
  const int texel = static_cast<int>(element.texel);
  return {(texel / grid.columns) >> level, (texel % grid.columns) >> level};
}

/// The elements whose own texels lie in a block.
std::vector<std::uint32_t> elementsIn(const Discretization& discretization, const Grid& grid, const Block& block,
                                      int level) {
  std::vector<std::uint32_t> elements;
  const int side = 1 << level;
  for (int row = block.first * side; row < std::min(grid.rows, (block.first + 1) * side); ++row)
    for (int column = block.second * side; column < std::min(grid.columns, (block.second + 1) * side); ++column) {
      const auto texel = static_cast<std::uint32_t>(row * grid.columns + column);
      const std::uint32_t element = grid.elementOfTexel[texel];
      if (discretization.elements[element].texel == texel) elements.push_back(element);
    }
  return elements;
}

/// Distributes a surface's part of a row over blocks.
class Spreader {
 public:
  Spreader(const Discretization& discretization, const FormFactorRow& row, const Run& run)
      : discretization_(discretization), row_(row), run_(run) {
    grid_ = &discretization.grids[elementAt(run.first).surface];
  }

  /// The lowest level with enough pixels per visible block.
  int levelFor(std::uint64_t pixels, double pixelsPerElement) const {
    int level = 0;
    for (std::size_t blocks = run_.end - run_.first;
         blocks > 1 && static_cast<double>(pixels) < pixelsPerElement * static_cast<double>(blocks);
         blocks = sharesByBlock(level).size())
      ++level;
    return level;
  }

  void append(int level, FormFactorRow& result) const {
    if (level == 0) {
      const auto first = static_cast<std::ptrdiff_t>(run_.first), end = static_cast<std::ptrdiff_t>(run_.end);
      result.elements.insert(result.elements.end(), row_.elements.begin() + first, row_.elements.begin() + end);
      result.shares.insert(result.shares.end(), row_.shares.begin() + first, row_.shares.begin() + end);
      return;
    }
    std::vector<std::pair<std::uint32_t, std::uint64_t>> spread;
    for (const auto& [block, share] : sharesByBlock(level)) {
      const std::vector<std::uint32_t> elements = elementsIn(discretization_, *grid_, block, level);
      double area = 0;
      for (const std::uint32_t element : elements) area += discretization_.elements[element].area;
      // Rounds the running total, not each share, so that the shares sum to that of the block.
      double areaSoFar = 0;
      std::uint64_t given = 0;
      for (const std::uint32_t element : elements) {
        areaSoFar += discretization_.elements[element].area;
        const bool isLast = element == elements.back();
        const auto upTo = isLast ? share : std::min(share, portion(share, areaSoFar / area));
        if (upTo > given) spread.emplace_back(element, upTo - given);
        given = std::max(given, upTo);
      }
    }
    std::sort(spread.begin(), spread.end());
    for (const auto& [element, share] : spread) {
      result.elements.push_back(element);
      result.shares.push_back(share);
    }
  }

 private:
  static std::uint64_t portion(std::uint64_t share, double part) {
    return static_cast<std::uint64_t>(static_cast<double>(share) * part);
  }

  const Element& elementAt(std::size_t i) const { return discretization_.elements[row_.elements[i]]; }

  std::map<Block, std::uint64_t> sharesByBlock(int level) const {
    std::map<Block, std::uint64_t> shares;
    for (std::size_t i = run_.first; i < run_.end; ++i) shares[blockOf(*grid_, elementAt(i), level)] += row_.shares[i];
    return shares;
  }

  const Discretization& discretization_;
  const FormFactorRow& row_;
  Run run_;
  const Grid* grid_ = nullptr;
};

}  // namespace

FormFactorRow withCoarserMaps(const Discretization& discretization, const FormFactorRow& row,
                              std::span<const std::uint32_t> pixels, double pixelsPerElement) {
  assert(pixels.size() == row.elements.size());
  FormFactorRow result{{}, {}, row.background, row.back};
  for (const Run& run : runsBySurface(discretization, row)) {
    const std::uint64_t sum = std::accumulate(pixels.begin() + static_cast<std::ptrdiff_t>(run.first),
                                              pixels.begin() + static_cast<std::ptrdiff_t>(run.end), std::uint64_t{0});
    const Spreader spreader(discretization, row, run);
    const int level = spreader.levelFor(sum, pixelsPerElement);
    spreader.append(level, result);
  }
  return result;
}

}  // namespace hemitex::radiosity
