/// The unshot flux of all patches, with the brightest patch and the total available without a pass over all patches.
/// Each tree node has 64 children and stores the largest absolute value and the sum of absolute values below it. When
/// patches change, their ancestors are recomputed from their children. So both values equal those of a new tree, and
/// rounding errors do not accumulate.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/base/bands.h"

namespace hemitex::radiosity {

class UnshotTree {
 public:
  /// Patches per lowest node.
  static constexpr std::uint32_t patchesInBlock = 64;

  /// One entry per patch; at least one.
  explicit UnshotTree(BandTable flux);

  const BandTable& flux() const { return flux_; }
  /// The flux of a patch, to change; call `update` afterwards. Blocks of different patches may be changed at the same
  /// time.
  std::span<double> ofPatch(std::uint32_t patch) {
    isChanged_[patch] = 1;
    return flux_[patch];
  }

  /// Appends patches without unshot flux up to this number; call `update` with their blocks afterwards.
  void grow(std::size_t patches);
  /// Updates the tree after changes in these blocks; duplicates are allowed. Returns the number of patches and nodes
  /// visited.
  std::size_t update(std::span<const std::uint32_t> blocks);

  /// The patch with the largest absolute flux, bands summed; the first of equals.
  std::uint32_t brightest() const { return levels_.back().nodes.front().brightest; }
  /// The patches with the largest absolute fluxes, in this order; at most `count`. Visits some nodes per patch.
  std::vector<std::uint32_t> brightestPatches(std::size_t count) const;
  /// The sum of the absolute fluxes of the patches: for each of three bands, or for other bands together, because a sum
  /// per band would visit all of them.
  std::span<const double> sizes() const { return levels_.back().sizes[0]; }

 private:
  struct Node {
    double largest = -1;
    std::uint32_t brightest = 0;
    std::uint32_t update = 0;  ///< number of the update that last computed the node

    void add(double size, std::uint32_t patch) {
      if (!(size > largest)) return;
      largest = size;
      brightest = patch;
    }
  };
  struct Level {
    std::vector<Node> nodes;
    BandTable sizes;  ///< one per node
  };

  std::size_t make(std::size_t level, std::uint32_t number);
  template <std::size_t bands>
  void sumPatches(std::size_t first, std::size_t end, Node& node, std::span<double> sizes);

  BandTable flux_;
  std::vector<double> sizes_;            ///< one per patch: the absolute flux, bands summed
  std::vector<std::uint8_t> isChanged_;  ///< one per patch: whether the size is of an earlier flux
  std::vector<Level> levels_;            ///< lowest first; the last has one node
  std::uint32_t updates_ = 0;
};

}  // namespace hemitex::radiosity
