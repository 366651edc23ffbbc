#include "radiosity/patch_splitting.h"

#include <algorithm>
#include <array>
#include <utility>

#include "radiosity/patch_points.h"
#include "radiosity/projected_rows.h"

namespace hemitex::radiosity {
namespace {

/// Of the hemicubes that say how near a patch is.
constexpr int scoutResolution = 32;

/// A part of a patch: a block of texels and the elements whose own texels lie there.
struct Part {
  Patch block;
  std::vector<std::uint32_t> elements;  ///< ascending
};

/// Cuts the patches of one discretization.
class Splitter {
 public:
  Splitter(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
           raster::ItemBufferRenderer& renderer, double mostReturning)
      : scene_(scene),
        discretization_(discretization),
        rows_(scene, discretization, layout, renderer, {.resolution = scoutResolution}),
        share_(discretization.patches.size()),
        mostReturning_(mostReturning) {
    for (const Patch& patch : discretization.patches) patchArea_.push_back(patchArea(discretization, patch));
  }

  /// Appends what becomes of a part.
  void split(const Part& part, std::vector<Part>& parts) {
    const double returning = returningShareOf(part);
    if (returning <= mostReturning_ || part.block.halvings == mostHalvings) {
      parts.push_back(part);
    } else if (std::max(part.block.width, part.block.height) > leafSideOf(part)) {
      for (const Part& quarter : quarters(part)) split(quarter, parts);
    } else {
      parts.push_back(withPoints(part, returning));
    }
  }

 private:
  /// Of its first element: a part is cut down to single elements.
  int leafSideOf(const Part& part) const {
    const Element& element = discretization_.elements[part.elements.front()];
    return leafOf(discretization_.grids[element.surface], element.texel).side;
  }

  double returningShareOf(const Part& part) {
    const Patch& block = part.block;
    const auto shooting = shootingBlock(scene_.surfaces[block.surface], discretization_.grids[block.surface],
                                        glm::dvec2(block.column, block.row), glm::dvec2(block.width, block.height));
    double area = 0;
    for (const std::uint32_t element : part.elements) area += discretization_.elements[element].area;
    const SurfacePoint centre =
        shooting ? shooting->centre : elementCentre(scene_, discretization_, part.elements.front());
    return returningShareOf(rows_.from(block.surface, centre), area);
  }

  /// Of what has this row and this area, all patches being white.
  double returningShareOf(const FormFactorRow& row, double area) {
    std::vector<std::uint32_t> seen;
    for (std::size_t i = 0; i < row.elements.size(); ++i) {
      const std::uint32_t patch = discretization_.patchOf[row.elements[i]];
      if (share_[patch] == 0) seen.push_back(patch);
      share_[patch] += row.shares[i];
    }
    double returning = 0;
    for (const std::uint32_t patch : seen) {
      const double factor = formFactor(std::exchange(share_[patch], 0));
      returning += factor * std::min(1.0, factor * area / patchArea_[patch]);
    }
    return returning;
  }

  /// The quarters that have elements, row by row; halves where the block is one texel wide or high.
  std::vector<Part> quarters(const Part& part) const {
    const Patch& block = part.block;
    const int width = (block.width + 1) / 2, height = (block.height + 1) / 2;
    std::array<Part, 4> quarter;
    for (int k = 0; k < 4; ++k) {
      Patch& cut = quarter[static_cast<std::size_t>(k)].block;
      const bool right = k % 2 == 1, upper = k / 2 == 1;
      cut = {block.surface,
             block.column + (right ? width : 0),
             block.row + (upper ? height : 0),
             right ? block.width - width : width,
             upper ? block.height - height : height,
             0,
             0,
             block.halvings + 1};
    }
    const int columns = discretization_.grids[block.surface].columns;
    for (const std::uint32_t element : part.elements) {
      const int texel = static_cast<int>(discretization_.elements[element].texel);
      const bool right = texel % columns >= block.column + width, upper = texel / columns >= block.row + height;
      quarter[static_cast<std::size_t>((upper ? 2 : 0) + (right ? 1 : 0))].elements.push_back(element);
    }
    std::vector<Part> parts;
    for (Part& cut : quarter)
      if (!cut.elements.empty()) parts.push_back(std::move(cut));
    return parts;
  }

  /// Each doubling of the points leaves a quarter of the area to each, and so of its light's way back.
  Part withPoints(Part part, double returning) const {
    for (; returning > mostReturning_ && part.block.halvings < mostHalvings; returning /= 4) {
      part.block.points *= 2;
      ++part.block.halvings;
    }
    return part;
  }

  const Scene& scene_;
  const Discretization& discretization_;
  ProjectedRows rows_;
  std::vector<double> patchArea_;     ///< one a patch
  std::vector<std::uint64_t> share_;  ///< one a patch, all 0 between rows
  double mostReturning_;
};

/// Puts parts in the place of patches, surface by surface.
void replacePatches(Discretization& discretization, const std::vector<Part>& parts) {
  discretization.patches.clear();
  discretization.patchElements.clear();
  for (Grid& grid : discretization.grids) grid.patchCount = 0;
  for (const Part& part : parts) {
    const auto number = static_cast<std::uint32_t>(discretization.patches.size());
    Grid& grid = discretization.grids[part.block.surface];
    if (grid.patchCount++ == 0) grid.firstPatch = number;
    Patch patch = part.block;
    patch.firstElement = static_cast<std::uint32_t>(discretization.patchElements.size());
    patch.elementCount = static_cast<std::uint32_t>(part.elements.size());
    discretization.patches.push_back(patch);
    for (const std::uint32_t element : part.elements) {
      discretization.patchOf[element] = number;
      discretization.patchElements.push_back(element);
    }
  }
}

}  // namespace

Discretization splitPatches(const Scene& scene, Discretization discretization, const WordLayout& layout,
                            raster::ItemBufferRenderer& renderer, double mostReturning) {
  if (mostReturning >= 1) return discretization;
  Splitter splitter(scene, discretization, layout, renderer, mostReturning);
  std::vector<Part> parts;
  for (const Patch& patch : discretization.patches) {
    const auto first = discretization.patchElements.begin() + patch.firstElement;
    splitter.split({patch, std::vector<std::uint32_t>(first, first + patch.elementCount)}, parts);
  }
  replacePatches(discretization, parts);
  return discretization;
}

}  // namespace hemitex::radiosity
