#include "radiosity/form_factors/patch_subdivision.h"

#include <algorithm>
#include <array>
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

/// A part of a patch: a block of texels and the elements whose own texels lie there.
struct PatchSubdivision::Part {
  Patch block;
  std::vector<std::uint32_t> elements;  ///< ascending
  int depth = 0;                        ///< number of halvings of its side, including the distance of its points
};

PatchSubdivision::PatchSubdivision(const Scene& scene, Discretization& discretization, const IdLayout& layout,
                                   raster::ItemBufferRenderer& renderer, double maxMisdirected)
    : scene_(scene),
      discretization_(discretization),
      rows_(scene, discretization, layout, renderer, {.resolution = scoutResolution}),
      share_(discretization.patches.size()),
      maxMisdirected_(maxMisdirected) {
  for (const Patch& patch : discretization.patches) patchArea_.push_back(patchArea(discretization, patch));
}

std::vector<std::uint32_t> PatchSubdivision::split(std::uint32_t number, double weight) {
  Patch& patch = discretization_.patches[number];
  if (patch.isSettled || maxMisdirected_ >= 1) return {};
  patch.isSettled = true;
  std::vector<Part> parts;
  split(wholeOf(patch), weight, parts);
  rowsAhead_.erase(discretization_.patchElements[patch.firstElement]);
  return replace(number, parts);
}

PatchSubdivision::Part PatchSubdivision::wholeOf(const Patch& patch) const {
  const auto first = discretization_.patchElements.begin() + patch.firstElement;
  return {patch, std::vector<std::uint32_t>(first, first + patch.elementCount)};
}

bool PatchSubdivision::wouldSplit(std::uint32_t number, double weight) {
  const Patch& patch = discretization_.patches[number];
  const double limit = maxMisdirected_ / std::sqrt(weight);
  if (patch.isSettled || maxMisdirected_ >= 1 || limit >= 1) return false;
  const Part whole = wholeOf(patch);
  if (!rowsAhead_.contains(whole.elements.front())) rowsAhead_[whole.elements.front()] = estimatingRow(whole);
  return misdirectedShareOf(whole) > limit;
}

/// Splits a part and appends the results.
void PatchSubdivision::split(Part part, double weight, std::vector<Part>& parts) {
  part.block.halvings = halvingsFor(weight);
  const double limit = maxMisdirected_ / std::sqrt(weight);
  // Even misdirecting all its light would be within the limit.
  const bool isFaint = limit >= 1;
  double misdirected = isFaint || part.depth == maxSplits ? 0 : misdirectedShareOf(part);
  if (misdirected <= limit) {
    parts.push_back(std::move(part));
    return;
  }
  if (std::max(part.block.width, part.block.height) > leafSideOf(part)) {
    const double area = areaOf(part);
    for (const Part& quarter : quarters(part)) split(quarter, weight * areaOf(quarter) / area, parts);
    return;
  }
  // Doubling the points per side leaves each point a quarter of the area, and so a quarter of the flux and of the
  // misdirected share.
  for (; misdirected > maxMisdirected_ / std::sqrt(weight) && part.depth < maxSplits; misdirected /= 4, weight /= 4) {
    part.block.points *= 2;
    ++part.depth;
  }
  part.block.halvings = halvingsFor(weight);
  parts.push_back(std::move(part));
}

double PatchSubdivision::areaOf(const Part& part) const {
  double area = 0;
  for (const std::uint32_t element : part.elements) area += discretization_.elements[element].area;
  return area;
}

/// The leaf side of its first element: parts are split down to single elements.
int PatchSubdivision::leafSideOf(const Part& part) const {
  const Element& element = discretization_.elements[part.elements.front()];
  return leafOf(discretization_.grids[element.surface], element.texel).side;
}

double PatchSubdivision::misdirectedShareOf(const Part& part) {
  const auto ahead = part.depth == 0 ? rowsAhead_.find(part.elements.front()) : rowsAhead_.end();
  return returningShareOf(ahead != rowsAhead_.end() ? ahead->second : estimatingRow(part), areaOf(part)) + foldOf(part);
}

FormFactorRow PatchSubdivision::estimatingRow(const Part& part) {
  const Patch& block = part.block;
  const auto shooting = shootingBlock(scene_.surfaces[block.surface], discretization_.grids[block.surface],
                                      glm::dvec2(block.column, block.row), glm::dvec2(block.width, block.height));
  const SurfacePoint centre =
      shooting ? shooting->centre : elementCentre(scene_, discretization_, part.elements.front());
  return rows_.from(block.surface, centre);
}

/// The number of elements minus the length of the sum of their normals, relative, both weighted by area.
double PatchSubdivision::foldOf(const Part& part) const {
  glm::dvec3 sum(0);
  for (const std::uint32_t element : part.elements)
    sum += discretization_.elements[element].area *
           normal(scene_.surfaces[part.block.surface].triangles[discretization_.triangleOf[element]]);
  return std::max(0.0, 1 - glm::length(sum) / areaOf(part));
}

/// The share that returns to a patch with this row and this area if all patches are white.
double PatchSubdivision::returningShareOf(const FormFactorRow& row, double area) {
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
    quarter[static_cast<std::size_t>(k)].depth = part.depth + 1;
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

/// Replaces a patch by parts: the first keeps its number, the others are appended. Their elements take the place of the
/// patch's elements in patchElements.
std::vector<std::uint32_t> PatchSubdivision::replace(std::uint32_t patch, const std::vector<Part>& parts) {
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

}  // namespace hemitex::radiosity
