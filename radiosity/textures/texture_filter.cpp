#include "radiosity/textures/texture_filter.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <utility>

#include "radiosity/textures/gouraud_texture.h"
#include "radiosity/textures/quadtree_texture.h"

namespace hemitex::radiosity {
namespace {

/// The grid texels around a position along one axis, with weights; texel centres are integers.
struct Taps {
  int first = 0;
  std::array<double, 5> weight{};
};

Taps tapsAt(TextureFilter filter, double place) {
  Taps taps{static_cast<int>(std::floor(place + 0.5)) - 2, {}};
  for (std::size_t i = 0; i < taps.weight.size(); ++i)
    taps.weight[i] = kernelWeight(filter, taps.first + static_cast<int>(i) - place);
  return taps;
}

/// A sum of weighted radiosity, and of weights.
struct WeightedSum {
  glm::dvec3 radiosity{0.0};
  double weight = 0;

  void add(double by, const WeightedSum& other) {
    radiosity += by * other.radiosity;
    weight += by * other.weight;
  }
};

/// The filter along one axis at the texels of the texture.
std::vector<Taps> tapsAlong(TextureFilter filter, int size, int magnification) {
  std::vector<Taps> taps;
  for (int texel = 0; texel < size * magnification; ++texel)
    taps.push_back(tapsAt(filter, (texel + 0.5) / magnification - 0.5));
  return taps;
}

/// Calls add(weight, texel) for the texels of the axis that weigh.
template <typename Add>
void forEachTap(const Taps& taps, int size, const Add& add) {
  for (std::size_t i = 0; i < taps.weight.size(); ++i) {
    const int texel = taps.first + static_cast<int>(i);
    if (texel >= 0 && texel < size && taps.weight[i] != 0) add(taps.weight[i], texel);
  }
}

/// One texel row of the grid, filtered along the row.
std::vector<WeightedSum> filteredRow(const Grid& grid, const std::vector<glm::dvec3>& radiosity, int row,
                                     const std::vector<Taps>& columns) {
  std::vector<WeightedSum> sums(columns.size());
  for (std::size_t i = 0; i < columns.size(); ++i)
    forEachTap(columns[i], grid.columns, [&](double weight, int column) {
      const auto texel = static_cast<std::size_t>(row * grid.columns + column);
      if (grid.covered[texel]) sums[i].add(weight, {radiosity[grid.elementOfTexel[texel]], 1});
    });
  return sums;
}

/// The texel rows of the grid, filtered along the row. Keeps only those that the next row of the texture needs.
class FilteredRows {
 public:
  FilteredRows(const Grid& grid, const std::vector<glm::dvec3>& radiosity, std::vector<Taps> columns)
      : grid_(grid), radiosity_(radiosity), columns_(std::move(columns)), rows_(static_cast<std::size_t>(grid.rows)) {}

  /// A row of the texture; rows are taken upwards.
  std::vector<WeightedSum> at(const Taps& taps) {
    std::vector<WeightedSum> sums(columns_.size());
    forEachTap(taps, grid_.rows, [&](double weight, int row) {
      std::vector<WeightedSum>& filtered = rows_[static_cast<std::size_t>(row)];
      if (filtered.empty()) filtered = filteredRow(grid_, radiosity_, row, columns_);
      for (std::size_t i = 0; i < sums.size(); ++i) sums[i].add(weight, filtered[i]);
    });
    for (; released_ < taps.first && released_ < grid_.rows; ++released_)
      rows_[static_cast<std::size_t>(released_)] = {};
    return sums;
  }

 private:
  const Grid& grid_;
  const std::vector<glm::dvec3>& radiosity_;
  const std::vector<Taps> columns_;
  std::vector<std::vector<WeightedSum>> rows_;
  int released_ = 0;
};

/// The values at the centres of the grid's texels; of those without area, the value of their element's own texel.
std::vector<glm::dvec3> valuesAtCentres(const Discretization& discretization, const Grid& grid,
                                        const std::vector<glm::dvec3>& radiosity, TextureFilter filter) {
  FilteredRows rows(grid, radiosity, tapsAlong(filter, grid.columns, 1));
  std::vector<glm::dvec3> values;
  for (const Taps& taps : tapsAlong(filter, grid.rows, 1))
    for (const WeightedSum& sum : rows.at(taps)) values.push_back(sum.radiosity / sum.weight);
  for (std::size_t texel = 0; texel < values.size(); ++texel)
    if (!grid.covered[texel]) values[texel] = values[discretization.elements[grid.elementOfTexel[texel]].texel];
  return values;
}

/// The weight of a texel is a product, so that rows are filtered first, then columns.
std::vector<glm::dvec3> byKernel(const Discretization& discretization, const Grid& grid,
                                 const std::vector<glm::dvec3>& radiosity, TextureFilter filter, int magnification) {
  const auto times = static_cast<std::size_t>(magnification), columns = static_cast<std::size_t>(grid.columns);
  const bool hasPhantoms = std::find(grid.covered.begin(), grid.covered.end(), false) != grid.covered.end();
  const std::vector<glm::dvec3> withoutArea =
      hasPhantoms ? valuesAtCentres(discretization, grid, radiosity, filter) : std::vector<glm::dvec3>();
  FilteredRows rows(grid, radiosity, tapsAlong(filter, grid.columns, magnification));
  const std::vector<Taps> taps = tapsAlong(filter, grid.rows, magnification);
  std::vector<glm::dvec3> texels;
  texels.reserve(columns * times * taps.size());
  for (std::size_t j = 0; j < taps.size(); ++j) {
    const std::vector<WeightedSum> sums = rows.at(taps[j]);
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::size_t texel = j / times * columns + i / times;
      texels.push_back(grid.covered[texel] ? sums[i].radiosity / sums[i].weight : withoutArea[texel]);
    }
  }
  return texels;
}

}  // namespace

double kernelWeight(TextureFilter filter, double distance) {
  const double t = std::abs(distance);
  switch (filter) {
    case TextureFilter::OneToOne:
      return t < 0.5 ? 1 : 0;
    case TextureFilter::Triangle:
      return std::max(0.0, 2 - t) / 4;
    case TextureFilter::Bilinear:
      return std::max(0.0, 1 - t);
    case TextureFilter::Bicubic: {
      const double far = std::max(0.0, 2 - t), near = std::max(0.0, 1 - t);
      return (far * far * far - 4 * near * near * near) / 6;
    }
    case TextureFilter::Quadtree:
    case TextureFilter::Gouraud:
      break;
  }
  assert(false);
  return 0;
}

bool hasKernel(TextureFilter filter) { return filter != TextureFilter::Quadtree && filter != TextureFilter::Gouraud; }

glm::dvec3 filteredValue(const Grid& grid, const std::vector<glm::dvec3>& radiosity, TextureFilter filter,
                         const glm::dvec2& place) {
  const Taps columns = tapsAt(filter, place.x - 0.5), rows = tapsAt(filter, place.y - 0.5);
  WeightedSum sum;
  forEachTap(rows, grid.rows, [&](double weight, int row) {
    forEachTap(columns, grid.columns, [&](double times, int column) {
      const auto texel = static_cast<std::size_t>(row * grid.columns + column);
      if (grid.covered[texel]) sum.add(weight * times, {radiosity[grid.elementOfTexel[texel]], 1});
    });
  });
  if (sum.weight > 0) return sum.radiosity / sum.weight;
  const int column = std::clamp(static_cast<int>(place.x), 0, grid.columns - 1),
            row = std::clamp(static_cast<int>(place.y), 0, grid.rows - 1);
  return radiosity[grid.elementOfTexel[static_cast<std::size_t>(row * grid.columns + column)]];
}

std::vector<glm::dvec3> filteredTexels(const Scene& scene, const Discretization& discretization, std::uint32_t surface,
                                       const std::vector<glm::dvec3>& radiosity, TextureFilter filter,
                                       int magnification) {
  const Grid& grid = discretization.grids[surface];
  if (filter == TextureFilter::Quadtree) return quadtreeTexels(discretization, grid, radiosity, magnification);
  if (filter == TextureFilter::Gouraud) return gouraudTexels(scene.surfaces[surface], grid, radiosity, magnification);
  return byKernel(discretization, grid, radiosity, filter, magnification);
}

}  // namespace hemitex::radiosity
