/// The unshot flux of all patches: the brightest one, and what all of them amount to, without a look at each. A tree
/// with 64 children a node holds of what is below it the largest size and the sum of the sizes; where patches change,
/// the nodes above them are made anew from their children. So both are what they would be if the tree were built
/// afresh, whatever was shot before, and no rounding piles up.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

class UnshotTree {
 public:
  /// Patches that share a lowest node.
  static constexpr std::uint32_t patchesInBlock = 64;

  /// One a patch; at least one.
  explicit UnshotTree(std::vector<glm::dvec3> flux);

  const std::vector<glm::dvec3>& flux() const { return flux_; }
  /// Adds to a patch. Blocks of different patches may be changed at the same time; `update` is to follow.
  void add(std::uint32_t patch, const glm::dvec3& flux) { flux_[patch] += flux; }
  void clear(std::uint32_t patch) { flux_[patch] = glm::dvec3(0); }

  /// Appends patches without unshot flux until there are so many; `update` is to follow with their blocks.
  void grow(std::size_t patches);
  /// After changes in these blocks, which may be named more than once. Returns how many patches and nodes it looked at.
  std::size_t update(std::span<const std::uint32_t> blocks);

  /// The patch of the largest size, bands summed; the first of equals.
  std::uint32_t brightest() const { return levels_.back().front().brightest; }
  /// The sum of the patches' sizes, per band.
  const glm::dvec3& sizes() const { return levels_.back().front().sizes; }

  std::size_t bytes() const;

 private:
  struct Node {
    glm::dvec3 sizes{0.0};
    double largest = -1;
    std::uint32_t brightest = 0;
    std::uint32_t update = 0;  ///< the last that it was made in

    void add(const glm::dvec3& size, double bands, std::uint32_t patch) {
      sizes += size;
      if (!(bands > largest)) return;
      largest = bands;
      brightest = patch;
    }
  };

  std::size_t make(std::size_t level, std::uint32_t number);

  std::vector<glm::dvec3> flux_;
  std::vector<std::vector<Node>> levels_;  ///< the lowest first; the last has one node
  std::uint32_t updates_ = 0;
};

}  // namespace hemitex::radiosity
