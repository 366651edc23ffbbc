#include "radiosity/form_factors/level_of_detail.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>
#include <vector>

namespace hemitex::radiosity {
namespace {

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

/// The entries [first, end) of a row that belong to one surface, with its grid.
struct Part {
  const Discretization& discretization;
  const FormFactorRow& row;
  const Grid& grid;
  std::size_t first, end;
};

std::map<Block, std::uint64_t> sharesByBlock(const Part& part, int level) {
  std::map<Block, std::uint64_t> shares;
  for (std::size_t i = part.first; i < part.end; ++i)
    shares[blockOf(part.grid, part.discretization.elements[part.row.elements[i]], level)] += part.row.shares[i];
  return shares;
}

/// The lowest level with enough pixels per visible block.
int levelFor(const Part& part, std::uint64_t pixels, double pixelsPerElement) {
  int level = 0;
  for (std::size_t blocks = part.end - part.first;
       blocks > 1 && static_cast<double>(pixels) < pixelsPerElement * static_cast<double>(blocks);
       blocks = sharesByBlock(part, level).size())
    ++level;
  return level;
}

/// Distributes the shares of a part over the elements of the blocks of a level, and appends them.
void append(const Part& part, int level, FormFactorRow& result) {
  const FormFactorRow& row = part.row;
  if (level == 0) {
    const auto first = static_cast<std::ptrdiff_t>(part.first), end = static_cast<std::ptrdiff_t>(part.end);
    result.elements.insert(result.elements.end(), row.elements.begin() + first, row.elements.begin() + end);
    result.shares.insert(result.shares.end(), row.shares.begin() + first, row.shares.begin() + end);
    return;
  }
  const std::vector<Element>& all = part.discretization.elements;
  std::vector<std::pair<std::uint32_t, std::uint64_t>> spread;
  for (const auto& [block, share] : sharesByBlock(part, level)) {
    const std::vector<std::uint32_t> elements = elementsIn(part.discretization, part.grid, block, level);
    double area = 0;
    for (const std::uint32_t element : elements) area += all[element].area;
    // Rounds the running total, not each share, so that the shares sum to that of the block.
    double areaSoFar = 0;
    std::uint64_t given = 0;
    for (const std::uint32_t element : elements) {
      areaSoFar += all[element].area;
      const auto portion = static_cast<std::uint64_t>(static_cast<double>(share) * (areaSoFar / area));
      const std::uint64_t upTo = element == elements.back() ? share : std::min(share, portion);
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

}  // namespace

FormFactorRow withCoarserMaps(const Discretization& discretization, const FormFactorRow& row,
                              std::span<const std::uint32_t> pixels, double pixelsPerElement) {
  assert(pixels.size() == row.elements.size());
  FormFactorRow result{{}, {}, row.background, row.back};
  const auto surfaceOf = [&](std::size_t i) { return discretization.elements[row.elements[i]].surface; };
  for (std::size_t first = 0, end = 0; first < row.elements.size(); first = end) {
    std::uint64_t sum = 0;
    for (; end < row.elements.size() && surfaceOf(end) == surfaceOf(first); ++end) sum += pixels[end];
    const Part part{discretization, row, discretization.grids[surfaceOf(first)], first, end};
    append(part, levelFor(part, sum, pixelsPerElement), result);
  }
  return result;
}

}  // namespace hemitex::radiosity
