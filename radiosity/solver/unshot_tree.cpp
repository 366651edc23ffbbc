#include "radiosity/solver/unshot_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <queue>
#include <tuple>
#include <utility>

namespace hemitex::radiosity {

constexpr std::size_t children = UnshotTree::patchesInBlock;

UnshotTree::UnshotTree(BandTable flux) : flux_(std::move(flux)) {
  assert(!flux_.empty());
  grow(flux_.size());
}

void UnshotTree::grow(std::size_t patches) {
  flux_.resize(patches);
  sizes_.resize(patches);
  isChanged_.resize(patches, 1);
  std::size_t count = patches;
  for (std::size_t level = 0; level == 0 || count > 1; ++level) {
    count = (count + children - 1) / children;
    if (level < levels_.size()) {
      levels_[level].nodes.resize(count);
      levels_[level].sizes.resize(count);
      continue;
    }
    levels_.push_back({std::vector<Node>(count), BandTable(count, flux_.bands == 3 ? 3 : 1)});
    for (std::uint32_t number = 0; number < count; ++number) make(level, number);
  }
}

/// Computes a lowest node from its patches. The size of three bands is computed faster than a branch is mispredicted.
template <std::size_t bands>
void UnshotTree::sumPatches(std::size_t first, std::size_t end, Node& node, std::span<double> sizes) {
  std::array<double, bands == 3 ? 3 : 1> sum{};  // not in memory that others may change
  for (std::size_t i = first; i < end; ++i) {
    const auto flux = flux_.of<bands>(i);
    if (bands == 3 || isChanged_[i]) sizes_[i] = sizeSum<bands>(flux);
    isChanged_[i] = 0;
    node.add(sizes_[i], static_cast<std::uint32_t>(i));
    if constexpr (bands == 3)
      for (std::size_t band = 0; band < bands; ++band) sum[band] += std::abs(flux[band]);
    else
      sum[0] += sizes_[i];
  }
  std::copy(sum.begin(), sum.end(), sizes.begin());
}

/// Computes a node from its children; returns their number.
std::size_t UnshotTree::make(std::size_t level, std::uint32_t number) {
  const std::size_t below = level == 0 ? flux_.size() : levels_[level - 1].nodes.size();
  const std::size_t first = number * children, end = std::min(first + children, below);
  Node node;
  node.update = updates_;
  const std::span<double> sizes = levels_[level].sizes[number];
  std::fill(sizes.begin(), sizes.end(), 0.0);
  if (level == 0 && flux_.bands == 3) {
    sumPatches<3>(first, end, node, sizes);
  } else if (level == 0) {
    sumPatches<std::dynamic_extent>(first, end, node, sizes);
  } else {
    const Level& lower = levels_[level - 1];
    for (std::size_t i = first; i < end; ++i) {
      addTo(sizes, lower.sizes[i]);
      node.add(lower.nodes[i].largest, lower.nodes[i].brightest);
    }
  }
  levels_[level].nodes[number] = node;
  return end - first;
}

std::size_t UnshotTree::update(std::span<const std::uint32_t> blocks) {
  ++updates_;
  std::size_t visits = 0;
  std::vector<std::uint32_t> changed(blocks.begin(), blocks.end());
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    std::size_t kept = 0;
    for (const std::uint32_t number : changed) {
      if (levels_[level].nodes[number].update == updates_) continue;
      visits += make(level, number);
      changed[kept++] = number / static_cast<std::uint32_t>(children);
    }
    changed.resize(kept);
  }
  return visits;
}

std::vector<std::uint32_t> UnshotTree::brightestPatches(std::size_t count) const {
  /// A node, or a patch with level 0. Levels of nodes count from 1.
  struct Candidate {
    double size;
    std::size_t level;
    std::uint32_t number;
    bool operator<(const Candidate& other) const { return std::tie(size, other.number) < std::tie(other.size, number); }
  };
  std::priority_queue<Candidate> open;
  open.push({levels_.back().nodes.front().largest, levels_.size(), 0});
  std::vector<std::uint32_t> patches;
  while (!open.empty() && patches.size() < count) {
    const Candidate largest = open.top();
    open.pop();
    if (largest.level == 0) {
      patches.push_back(largest.number);
      continue;
    }
    const std::size_t level = largest.level - 1;
    const std::size_t below = level == 0 ? flux_.size() : levels_[level - 1].nodes.size();
    const std::size_t first = largest.number * children, end = std::min(first + children, below);
    for (std::size_t i = first; i < end; ++i) {
      const double size = level == 0 ? sizes_[i] : levels_[level - 1].nodes[i].largest;
      if (size > 0) open.push({size, level, static_cast<std::uint32_t>(i)});
    }
  }
  return patches;
}

}  // namespace hemitex::radiosity
