#include "radiosity/patch_splitting.h"

#include <algorithm>
#include <array>
#include <utility>

#include "radiosity/patch_points.h"

namespace hemitex::radiosity {
namespace {

/// Of the hemicubes that say how near a patch is.
constexpr int scoutResolution = 32;

}  // namespace

/// A part of a patch: a block of texels and the elements whose own texels lie there.
struct PatchSplitter::Part {
  Patch block;
  std::vector<std::uint32_t> elements;  ///< ascending
};

PatchSplitter::PatchSplitter(const Scene& scene, Discretization& discretization, const WordLayout& layout,
                             raster::ItemBufferRenderer& renderer, double mostReturning)
    : scene_(scene),
      discretization_(discretization),
      rows_(scene, discretization, layout, renderer, {.resolution = scoutResolution}),
      share_(discretization.patches.size()),
      mostReturning_(mostReturning) {
  for (const Patch& patch : discretization.patches) patchArea_.push_back(patchArea(discretization, patch));
}

std::vector<std::uint32_t> PatchSplitter::split(std::uint32_t number, double weight) {
  Patch& patch = discretization_.patches[number];
  if (patch.isSettled || mostReturning_ >= 1) return {};
  patch.isSettled = true;
  const auto first = discretization_.patchElements.begin() + patch.firstElement;
  std::vector<Part> parts;
  split({patch, std::vector<std::uint32_t>(first, first + patch.elementCount)}, weight, parts);
  return replace(number, parts);
}

/// Appends what becomes of a part.
void PatchSplitter::split(const Part& part, double weight, std::vector<Part>& parts) {
  const double limit = mostReturning_ / weight;
  // Not even all of its light would be too much.
  if (limit >= 1 || part.block.halvings == mostHalvings) {
    parts.push_back(part);
    return;
  }
  const double area = areaOf(part);
  double returning = returningShareOf(part, area);
  if (returning <= limit) {
    parts.push_back(part);
  } else if (std::max(part.block.width, part.block.height) > leafSideOf(part)) {
    for (const Part& quarter : quarters(part)) split(quarter, weight * areaOf(quarter) / area, parts);
  } else {
    // Each doubling of the points leaves a quarter of the area to each, and so of its flux and of its light's way back.
    Part finer = part;
    for (; returning > limit && finer.block.halvings < mostHalvings; returning /= 16) {
      finer.block.points *= 2;
      ++finer.block.halvings;
    }
    parts.push_back(finer);
  }
}

double PatchSplitter::areaOf(const Part& part) const {
  double area = 0;
  for (const std::uint32_t element : part.elements) area += discretization_.elements[element].area;
  return area;
}

/// Of its first element: a part is cut down to single elements.
int PatchSplitter::leafSideOf(const Part& part) const {
  const Element& element = discretization_.elements[part.elements.front()];
  return leafOf(discretization_.grids[element.surface], element.texel).side;
}

double PatchSplitter::returningShareOf(const Part& part, double area) {
  const Patch& block = part.block;
  const auto shooting = shootingBlock(scene_.surfaces[block.surface], discretization_.grids[block.surface],
                                      glm::dvec2(block.column, block.row), glm::dvec2(block.width, block.height));
  const SurfacePoint centre =
      shooting ? shooting->centre : elementCentre(scene_, discretization_, part.elements.front());
  return returningShareOf(rows_.from(block.surface, centre), area);
}

/// Of what has this row and this area, all patches being white.
double PatchSplitter::returningShareOf(const FormFactorRow& row, double area) {
  std::vector<std::uint32_t> seen;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const std::uint32_t patch = discretization_.patchOf[row.elements[i]];
    if (share_[patch] == 0) seen.push_back(patch);
    share_[patch] += row.shares[i];
  }
  double returning = formFactor(row.back);
  for (const std::uint32_t patch : seen) {
    const double factor = formFactor(std::exchange(share_[patch], 0));
    returning += factor * std::min(1.0, factor * area / patchArea_[patch]);
  }
  return returning;
}

/// The quarters that have elements, row by row; halves where the block is one texel wide or high.
std::vector<PatchSplitter::Part> PatchSplitter::quarters(const Part& part) const {
  const Patch& block = part.block;
  const int width = (block.width + 1) / 2, height = (block.height + 1) / 2;
  std::array<Part, 4> quarter;
  for (int k = 0; k < 4; ++k) {
    const bool right = k % 2 == 1, upper = k / 2 == 1;
    Patch& cut = quarter[static_cast<std::size_t>(k)].block;
    cut = block;
    cut.column += right ? width : 0;
    cut.row += upper ? height : 0;
    cut.width = right ? block.width - width : width;
    cut.height = upper ? block.height - height : height;
    ++cut.halvings;
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

/// Puts parts in the place of a patch: the first takes its number, the others are appended. Their elements lie where
/// those of the patch did.
std::vector<std::uint32_t> PatchSplitter::replace(std::uint32_t patch, const std::vector<Part>& parts) {
  std::uint32_t place = discretization_.patches[patch].firstElement;
  std::vector<std::uint32_t> added;
  for (const Part& part : parts) {
    const bool isFirst = &part == &parts.front();
    const std::uint32_t number = isFirst ? patch : static_cast<std::uint32_t>(discretization_.patches.size());
    if (!isFirst) {
      added.push_back(number);
      discretization_.patches.emplace_back();
      discretization_.grids[part.block.surface].laterPatches.push_back(number);
      patchArea_.push_back(0);
      share_.push_back(0);
    }
    Patch& replaced = discretization_.patches[number];
    replaced = part.block;
    replaced.firstElement = place;
    replaced.elementCount = static_cast<std::uint32_t>(part.elements.size());
    if (!isFirst) replaced.turn = {};
    for (const std::uint32_t element : part.elements) {
      discretization_.patchElements[place++] = element;
      discretization_.patchOf[element] = number;
    }
    patchArea_[number] = areaOf(part);
  }
  return added;
}

Discretization splitPatches(const Scene& scene, Discretization discretization, const WordLayout& layout,
                            raster::ItemBufferRenderer& renderer, double mostReturning) {
  PatchSplitter splitter(scene, discretization, layout, renderer, mostReturning);
  const auto count = static_cast<std::uint32_t>(discretization.patches.size());
  for (std::uint32_t patch = 0; patch < count; ++patch) splitter.split(patch, 1);
  return discretization;
}

}  // namespace hemitex::radiosity
