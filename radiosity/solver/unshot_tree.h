/// The unshot flux of all patches, with the brightest patch and the total available without a pass over all patches.
/// Each tree node has 64 children and stores the largest absolute value and the sum of absolute values below it. When
/// patches change, their ancestors are recomputed from their children. So both values equal those of a new tree, and
/// rounding errors do not accumulate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

class UnshotTree {
 public:
  /// Patches per lowest node.
  static constexpr std::uint32_t patchesInBlock = 64;

  /// One entry per patch; at least one.
  explicit UnshotTree(std::vector<glm::dvec3> flux);

  const std::vector<glm::dvec3>& flux() const { return flux_; }
  /// Adds to a patch; call `update` afterwards. Blocks of different patches may be changed at the same time.
  void add(std::uint32_t patch, const glm::dvec3& flux) { flux_[patch] += flux; }
  void clear(std::uint32_t patch) { flux_[patch] = glm::dvec3(0); }

  /// Appends patches without unshot flux up to this number; call `update` with their blocks afterwards.
  void grow(std::size_t patches);
  /// Updates the tree after changes in these blocks; duplicates are allowed. Returns the number of patches and nodes
  /// visited.
  std::size_t update(std::span<const std::uint32_t> blocks);

  /// The patch with the largest absolute flux, bands summed; the first of equals.
  std::uint32_t brightest() const { return levels_.back().front().brightest; }
  /// The patches with the largest absolute fluxes, in this order; at most `count`. Visits some nodes per patch.
  std::vector<std::uint32_t> brightestPatches(std::size_t count) const;
  /// The sum of the absolute fluxes of the patches, per band.
  const glm::dvec3& sizes() const { return levels_.back().front().sizes; }

 private:
  struct Node {
    glm::dvec3 sizes{0.0};
    double largest = -1;
    std::uint32_t brightest = 0;
    std::uint32_t update = 0;  ///< number of the update that last computed the node

    void add(const glm::dvec3& size, double bands, std::uint32_t patch) {
      sizes += size;
      if (!(bands > largest)) return;
      largest = bands;
      brightest = patch;
    }
  };

  std::size_t make(std::size_t level, std::uint32_t number);

  std::vector<glm::dvec3> flux_;
  std::vector<std::vector<Node>> levels_;  ///< lowest first; the last has one node
  std::uint32_t updates_ = 0;
};

}  // namespace hemitex::radiosity
