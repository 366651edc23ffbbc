#include "radiosity/solver/unshot_tree.h"

#include <algorithm>
#include <cassert>
#include <queue>
#include <tuple>
#include <utility>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

constexpr std::size_t children = UnshotTree::patchesInBlock;

UnshotTree::UnshotTree(std::vector<glm::dvec3> flux) : flux_(std::move(flux)) {
  assert(!flux_.empty());
  grow(flux_.size());
}

void UnshotTree::grow(std::size_t patches) {
  flux_.resize(patches);
  std::size_t count = patches;
  for (std::size_t level = 0; level == 0 || count > 1; ++level) {
    count = (count + children - 1) / children;
    if (level < levels_.size()) {
      levels_[level].resize(count);
      continue;
    }
    levels_.emplace_back(count);
    for (std::uint32_t number = 0; number < count; ++number) make(level, number);
  }
}

/// Computes a node from its children; returns their number.
std::size_t UnshotTree::make(std::size_t level, std::uint32_t number) {
  const std::size_t below = level == 0 ? flux_.size() : levels_[level - 1].size();
  const std::size_t first = number * children, end = std::min(first + children, below);
  Node node;
  node.update = updates_;
  for (std::size_t i = first; i < end; ++i) {
    if (level == 0) {
      const glm::dvec3 size = glm::abs(flux_[i]);
      node.add(size, bandSum(size), static_cast<std::uint32_t>(i));
    } else {
      const Node& child = levels_[level - 1][i];
      node.add(child.sizes, child.largest, child.brightest);
    }
  }
  levels_[level][number] = node;
  return end - first;
}

std::size_t UnshotTree::update(std::span<const std::uint32_t> blocks) {
  ++updates_;
  std::size_t visits = 0;
  std::vector<std::uint32_t> changed(blocks.begin(), blocks.end());
  for (std::size_t level = 0; level < levels_.size(); ++level) {
    std::size_t kept = 0;
    for (const std::uint32_t number : changed) {
      if (levels_[level][number].update == updates_) continue;
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
  open.push({levels_.back().front().largest, levels_.size(), 0});
  std::vector<std::uint32_t> patches;
  while (!open.empty() && patches.size() < count) {
    const Candidate largest = open.top();
    open.pop();
    if (largest.level == 0) {
      patches.push_back(largest.number);
      continue;
    }
    const std::size_t level = largest.level - 1;
    const std::size_t below = level == 0 ? flux_.size() : levels_[level - 1].size();
    const std::size_t first = largest.number * children, end = std::min(first + children, below);
    for (std::size_t i = first; i < end; ++i) {
      const double size = level == 0 ? bandSum(glm::abs(flux_[i])) : levels_[level - 1][i].largest;
      if (size > 0) open.push({size, level, static_cast<std::uint32_t>(i)});
    }
  }
  return patches;
}

}  // namespace hemitex::radiosity
