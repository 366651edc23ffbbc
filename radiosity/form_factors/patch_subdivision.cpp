#include "radiosity/form_factors/patch_subdivision.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "radiosity/discretization/patch_points.h"

namespace hemitex::radiosity {
namespace {

/// Resolution of the hemicubes for the estimate.
constexpr int scoutResolution = 32;
/// Parts of at least `weightOfWhole` are drawn at full resolution, those below 1 / `weightOfHalving` of it at half the
/// resolution, and so on. The error of a row falls with the 1.5th power of the resolution, and its time grows with the
/// square. The smallest error for a given time needs resolutions proportional to the weight to the power of 1 / 2.5.
constexpr double weightOfWhole = 2, weightOfHalving = 5.656854249492381;

}  // namespace

int halvingsFor(double weight) {
  int halvings = 0;
  for (; weight * weightOfHalving <= weightOfWhole && halvings < maxHalvings; weight *= weightOfHalving) ++halvings;
  return halvings;
}

/// A part of a patch.
struct PatchSubdivision::Part {
  Patch block;
  int depth = 0;  ///< number of halvings of its side, including the distance of its points
};

PatchSubdivision::PatchSubdivision(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                                   raster::ItemBufferRenderer& renderer, double maxMisdirected)
    : scene_(scene),
      discretization_(discretization),
      rows_(scene, discretization, layout, renderer, {.resolution = scoutResolution}),
      maxMisdirected_(maxMisdirected) {
  assert(maxMisdirected < 1);
}

std::vector<Patch> PatchSubdivision::split(const Patches& patches, const Patch& patch, double weight) {
  Part whole{patch};
  whole.block.isSettled = true;
  std::vector<Patch> parts;
  split(patches, std::move(whole), weight, parts);
  rowsAhead_.erase(patch.elements.front());
  return parts;
}

const FormFactorRow& PatchSubdivision::scoutRow(const Patch& patch) {
  const auto found = rowsAhead_.find(patch.elements.front());
  if (found != rowsAhead_.end()) return found->second;
  return rowsAhead_[patch.elements.front()] = estimatingRow(patch);
}

bool PatchSubdivision::wouldSplit(const Patches& patches, const Patch& patch, double weight) {
  const double limit = maxMisdirected_ / std::sqrt(weight);
  if (patch.isSettled || limit >= 1) return false;
  scoutRow(patch);
  return misdirectedShareOf(patches, {patch}) > limit;
}

/// Splits a part and appends the results.
void PatchSubdivision::split(const Patches& patches, Part part, double weight, std::vector<Patch>& parts) {
  part.block.halvings = halvingsFor(weight);
  const double limit = maxMisdirected_ / std::sqrt(weight);
  // Even misdirecting all its light would be within the limit.
  const bool isFaint = limit >= 1;
  double misdirected = isFaint || part.depth == maxSplits ? 0 : misdirectedShareOf(patches, part);
  if (misdirected <= limit) {
    parts.push_back(std::move(part.block));
    return;
  }
  if (std::max(part.block.width, part.block.height) > leafSideOf(part.block)) {
    for (const Part& quarter : quarters(part))
      split(patches, quarter, weight * quarter.block.area / part.block.area, parts);
    return;
  }
  // Doubling the points per side leaves each point a quarter of the area, and so a quarter of the flux and of the
  // misdirected share.
  for (; misdirected > maxMisdirected_ / std::sqrt(weight) && part.depth < maxSplits; misdirected /= 4, weight /= 4) {
    part.block.points *= 2;
    ++part.depth;
  }
  part.block.halvings = halvingsFor(weight);
  parts.push_back(std::move(part.block));
}

/// The leaf side of its first element: parts are split down to single elements.
int PatchSubdivision::leafSideOf(const Patch& block) const {
  const Element& element = discretization_.elements[block.elements.front()];
  return leafOf(discretization_.grids[element.surface], element.texel).side;
}

double PatchSubdivision::misdirectedShareOf(const Patches& patches, const Part& part) {
  const Patch& block = part.block;
  const auto ahead = part.depth == 0 ? rowsAhead_.find(block.elements.front()) : rowsAhead_.end();
  return returningShareOf(patches, ahead != rowsAhead_.end() ? ahead->second : estimatingRow(block), block.area) +
         foldOf(block);
}

FormFactorRow PatchSubdivision::estimatingRow(const Patch& block) {
  return rows_.from(block.surface, patchCentre(scene_, discretization_, block));
}

/// The number of elements minus the length of the sum of their normals, relative, both weighted by area.
double PatchSubdivision::foldOf(const Patch& block) const {
  glm::dvec3 sum(0);
  for (const std::uint32_t element : block.elements)
    sum += discretization_.elements[element].area *
           normal(scene_.surfaces[block.surface].triangles[discretization_.triangleOf[element]]);
  return std::max(0.0, 1 - glm::length(sum) / block.area);
}

/// The share that returns to a patch with this row and this area if all patches are white.
double PatchSubdivision::returningShareOf(const Patches& patches, const FormFactorRow& row, double area) {
  share_.resize(patches.list.size());
  std::vector<std::uint32_t> seen;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const std::uint32_t patch = patches.ofElement[row.elements[i]];
    if (share_[patch] == 0) seen.push_back(patch);
    share_[patch] += row.shares[i];
  }
  double returning = formFactor(row.back);
  for (const std::uint32_t patch : seen) {
    const double factor = formFactor(std::exchange(share_[patch], 0));
    returning += factor * std::min(1.0, factor * area / patches.list[patch].area);
  }
  return returning;
}

/// The quarters that have elements, row by row; halves if the block is one texel wide or high.
std::vector<PatchSubdivision::Part> PatchSubdivision::quarters(const Part& part) const {
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
    cut.elements.clear();
    cut.area = 0;
    quarter[static_cast<std::size_t>(k)].depth = part.depth + 1;
  }
  const int columns = discretization_.grids[block.surface].columns;
  for (const std::uint32_t number : block.elements) {
    const Element& element = discretization_.elements[number];
    const int texel = static_cast<int>(element.texel);
    const bool right = texel % columns >= block.column + width, upper = texel / columns >= block.row + height;
    Patch& cut = quarter[static_cast<std::size_t>((upper ? 2 : 0) + (right ? 1 : 0))].block;
    cut.elements.push_back(number);
    cut.area += element.area;
  }
  std::vector<Part> parts;
  for (Part& cut : quarter)
    if (!cut.block.elements.empty()) parts.push_back(std::move(cut));
  return parts;
}

}  // namespace hemitex::radiosity
