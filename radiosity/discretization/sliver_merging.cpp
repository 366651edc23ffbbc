#include "radiosity/discretization/sliver_merging.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <optional>

#include "radiosity/geometry/distance_transform.h"

namespace hemitex::radiosity {
namespace {

/// Groups of merged texels: a union-find forest.
class TexelGroups {
 public:
  explicit TexelGroups(const std::vector<double>& coverage) : parent_(coverage.size()), coverage_(coverage) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  std::uint32_t groupOf(std::uint32_t texel) {
    while (parent_[texel] != texel) {
      parent_[texel] = parent_[parent_[texel]];
      texel = parent_[texel];
    }
    return texel;
  }
  double coverage(std::uint32_t texel) { return coverage_[groupOf(texel)]; }
  bool isSliver(std::uint32_t texel) { return coverage(texel) < sliverCoverage - coverageNoise; }

  void merge(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t from = groupOf(a), into = groupOf(b);
    parent_[from] = into;
    coverage_[into] += coverage_[from];
  }

 private:
  std::vector<std::uint32_t> parent_;
  std::vector<double> coverage_;  ///< at the root of a group, for the whole group
};

struct Step {
  int column, row;
};

// In ascending order of the texel number.
constexpr std::array<Step, 4> acrossEdges{{{0, -1}, {-1, 0}, {1, 0}, {0, 1}}};
constexpr std::array<Step, 4> acrossCorners{{{-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};

/// A grid of texels whose slivers merge.
class SliverMerging {
 public:
  SliverMerging(int columns, int rows, const std::vector<double>& coverage)
      : columns_(columns), rows_(rows), coverage_(coverage), groups_(coverage) {
    for (std::uint32_t texel = 0; texel < coverage.size(); ++texel)
      if (coverage[texel] > coverageNoise && groups_.isSliver(texel)) slivers_.push_back(texel);
    std::stable_sort(slivers_.begin(), slivers_.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return coverage[a] < coverage[b]; });
  }

  /// A sliver may have only neighbours of its own small group while another member has others. So the loop visits the
  /// slivers until none merges. Each round at least halves the number of groups that can still merge.
  void run() {
    bool hasMerged = true;
    while (hasMerged) {
      hasMerged = false;
      for (const std::uint32_t sliver : slivers_) {
        if (!groups_.isSliver(sliver)) continue;
        const std::optional<std::uint32_t> neighbour = largestNeighbour(sliver);
        if (neighbour) groups_.merge(sliver, *neighbour);
        hasMerged |= neighbour.has_value();
      }
    }
  }

  /// For each texel the texel with the largest coverage in its group.
  std::vector<std::uint32_t> ownTexels() {
    const auto count = static_cast<std::uint32_t>(coverage_.size());
    std::vector<std::uint32_t> largest(count), own(count);
    std::iota(largest.begin(), largest.end(), 0u);
    for (std::uint32_t texel = 0; texel < count; ++texel) {
      std::uint32_t& current = largest[groups_.groupOf(texel)];
      if (coverage_[texel] > coverage_[current] || (coverage_[texel] == coverage_[current] && texel < current))
        current = texel;
    }
    for (std::uint32_t texel = 0; texel < count; ++texel) own[texel] = largest[groups_.groupOf(texel)];
    return own;
  }

 private:
  std::optional<std::uint32_t> largestNeighbour(std::uint32_t texel) {
    const std::optional<std::uint32_t> acrossEdge = largestNeighbour(texel, acrossEdges);
    return acrossEdge ? acrossEdge : largestNeighbour(texel, acrossCorners);
  }

  std::optional<std::uint32_t> largestNeighbour(std::uint32_t texel, const std::array<Step, 4>& steps) {
    const int column = static_cast<int>(texel) % columns_, row = static_cast<int>(texel) / columns_;
    std::optional<std::uint32_t> largest;
    for (const Step& step : steps) {
      const int i = column + step.column, j = row + step.row;
      if (i < 0 || j < 0 || i >= columns_ || j >= rows_) continue;
      const auto neighbour = static_cast<std::uint32_t>(j * columns_ + i);
      if (coverage_[neighbour] <= coverageNoise || groups_.groupOf(neighbour) == groups_.groupOf(texel)) continue;
      if (!largest || groups_.coverage(neighbour) > groups_.coverage(*largest)) largest = neighbour;
    }
    return largest;
  }

  int columns_, rows_;
  const std::vector<double>& coverage_;
  TexelGroups groups_;
  std::vector<std::uint32_t> slivers_;  ///< ascending by coverage, then by texel
};

}  // namespace

std::vector<std::uint32_t> mergeSlivers(int columns, int rows, const std::vector<double>& coverage) {
  SliverMerging merging(columns, rows, coverage);
  merging.run();
  const std::vector<std::uint32_t> own = merging.ownTexels();
  std::vector<bool> covered(coverage.size());
  for (std::size_t texel = 0; texel < coverage.size(); ++texel) covered[texel] = coverage[texel] > coverageNoise;
  std::vector<std::uint32_t> merged = nearestCovered(columns, rows, covered);
  for (std::uint32_t& texel : merged) texel = own[texel];
  return merged;
}

}  // namespace hemitex::radiosity
