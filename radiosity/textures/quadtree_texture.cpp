#include "radiosity/textures/quadtree_texture.h"

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <optional>

namespace hemitex::radiosity {
namespace {

/// A leaf at a vertex, and the radiosity of its element if it has area.
struct Quadrant {
  Leaf leaf;
  const glm::dvec3* radiosity = nullptr;
};

/// The weighted mean of the leaves at a vertex.
struct VertexMean {
  glm::dvec3 value{0.0};
  double inverseSides = 0;  ///< the sum of 1 / side
  int leaves = 0;           ///< number of leaves with area
  int largestSide = 0;
};

class CornerValues {
 public:
  CornerValues(const Discretization& discretization, const Grid& grid, const std::vector<glm::dvec3>& radiosity)
      : grid_(grid),
        leafRadiosity_(grid.elementOfTexel.size(), nullptr),
        values_(static_cast<std::size_t>((grid.columns + 1) * (grid.rows + 1))) {
    for (const std::uint32_t e : elementsOf(grid))
      leafRadiosity_[lowestTexel(leafOf(grid, discretization.elements[e].texel))] = &radiosity[e];
  }

  bool hasArea(const Leaf& leaf) const { return leafRadiosity_[lowestTexel(leaf)] != nullptr; }

  /// The value at a corner of a leaf that has area.
  glm::dvec3 at(int column, int row) {
    std::optional<glm::dvec3>& value = values_[static_cast<std::size_t>(row * (grid_.columns + 1) + column)];
    if (!value) value = found(column, row);
    return *value;
  }

 private:
  std::size_t lowestTexel(const Leaf& leaf) const {
    return static_cast<std::size_t>(leaf.row * grid_.columns + leaf.column);
  }

  bool isInside(int column, int row) const {
    return column >= 0 && row >= 0 && column < grid_.columns && row < grid_.rows;
  }

  std::vector<Quadrant> quadrantsAt(int column, int row) const {
    std::vector<Quadrant> quadrants;
    for (const int r : {row - 1, row})
      for (const int c : {column - 1, column}) {
        if (!isInside(c, r)) continue;
        const Leaf leaf = leafOf(grid_, static_cast<std::uint32_t>(r * grid_.columns + c));
        quadrants.push_back({leaf, leafRadiosity_[lowestTexel(leaf)]});
      }
    return quadrants;
  }

  glm::dvec3 found(int column, int row) {
    const std::vector<Quadrant> quadrants = quadrantsAt(column, row);
    for (const Quadrant& quadrant : quadrants)
      if (const std::optional<glm::dvec3> value = constrained(quadrant, column, row)) return *value;
    const VertexMean mean = meanOf(quadrants);
    const bool onEdge = column == 0 || row == 0 || column == grid_.columns || row == grid_.rows;
    return onEdge ? carriedToEdge(mean, quadrants.size(), column, row) : mean.value;
  }

  /// The mean of the ends of the leaf's edge if the vertex is in the middle of that edge. Nothing if it is a corner, or
  /// if the leaf has no area.
  std::optional<glm::dvec3> constrained(const Quadrant& quadrant, int column, int row) {
    const Leaf& leaf = quadrant.leaf;
    if (quadrant.radiosity == nullptr) return std::nullopt;
    const int fromLeft = column - leaf.column, fromBelow = row - leaf.row;
    const bool atSide = fromLeft == 0 || fromLeft == leaf.side, atEnd = fromBelow == 0 || fromBelow == leaf.side;
    if (atSide && atEnd) return std::nullopt;
    if (atSide) return (at(column, leaf.row) + at(column, leaf.row + leaf.side)) / 2.0;
    return (at(leaf.column, row) + at(leaf.column + leaf.side, row)) / 2.0;
  }

  static VertexMean meanOf(const std::vector<Quadrant>& quadrants) {
    VertexMean mean;
    for (const Quadrant& quadrant : quadrants) {
      if (quadrant.radiosity == nullptr) continue;
      mean.value += *quadrant.radiosity / static_cast<double>(quadrant.leaf.side);
      mean.inverseSides += 1.0 / quadrant.leaf.side;
      mean.largestSide = std::max(mean.largestSide, quadrant.leaf.side);
      ++mean.leaves;
    }
    assert(mean.leaves > 0);
    mean.value /= mean.inverseSides;
    return mean;
  }

  /// Extrapolates the mean, which lies inside the chart, to the edge. The second point of the line is the vertex on the
  /// other side of the largest adjacent leaf. Returns the mean if leaves have no area or the chart is one leaf wide.
  glm::dvec3 carriedToEdge(const VertexMean& mean, std::size_t quadrants, int column, int row) {
    const int side = mean.largestSide;
    const auto inwards = [side](int place, int end) { return place == 0 ? side : place == end ? place - side : place; };
    const int innerColumn = inwards(column, grid_.columns), innerRow = inwards(row, grid_.rows);
    const bool innerIsInside = innerColumn > 0 && innerColumn < grid_.columns && innerRow > 0 && innerRow < grid_.rows;
    if (static_cast<std::size_t>(mean.leaves) < quadrants || !innerIsInside) return mean.value;
    const glm::dvec3 inner = at(innerColumn, innerRow);
    const double within = mean.leaves / (2 * mean.inverseSides);
    return glm::max(mean.value + (mean.value - inner) * (within / (side - within)), glm::dvec3(0));
  }

  const Grid& grid_;
  std::vector<const glm::dvec3*> leafRadiosity_;  ///< by the leaf's lowest texel; null without area
  std::vector<std::optional<glm::dvec3>> values_;
};

}  // namespace

std::vector<glm::dvec3> quadtreeTexels(const Discretization& discretization, const Grid& grid,
                                       const std::vector<glm::dvec3>& radiosity, int magnification) {
  CornerValues corners(discretization, grid, radiosity);
  std::vector<glm::dvec3> texels;
  for (int j = 0; j < grid.rows * magnification; ++j)
    for (int i = 0; i < grid.columns * magnification; ++i) {
      const auto texel = static_cast<std::uint32_t>(j / magnification * grid.columns + i / magnification);
      const Leaf leaf = leafOf(grid, texel);
      if (!corners.hasArea(leaf)) {
        texels.push_back(radiosity[grid.elementOfTexel[texel]]);
        continue;
      }
      const glm::dvec2 place = (glm::dvec2(i, j) + 0.5) / static_cast<double>(magnification);
      const glm::dvec2 t = (place - glm::dvec2(leaf.column, leaf.row)) / static_cast<double>(leaf.side);
      const int right = leaf.column + leaf.side, above = leaf.row + leaf.side;
      const glm::dvec3 below = glm::mix(corners.at(leaf.column, leaf.row), corners.at(right, leaf.row), t.x);
      texels.push_back(glm::mix(below, glm::mix(corners.at(leaf.column, above), corners.at(right, above), t.x), t.y));
    }
  return texels;
}

}  // namespace hemitex::radiosity
