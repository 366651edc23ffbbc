#include "radiosity/form_factors/gathered_rows.h"

#include <algorithm>
#include <numeric>
#include <span>

#include "radiosity/form_factors/projected_form_factors.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Texels along the side of a block.
constexpr int blockSide = 4;
/// Blocks are gathered that are drawn with this number of pixels per element or more.
constexpr double gatheredPixels = 0.5;
/// The error of the sum of gathered shares. If it differs more from the sum of drawn ones, that of the drawn ones,
/// which are those of a single point, is wrong.
constexpr double mostScaled = 0.005;

/// The number of the block of an element on its surface.
std::size_t blockOf(const Grid& grid, std::uint32_t texel) {
  const auto columns = static_cast<std::uint32_t>(grid.columns);
  const std::uint32_t blocks = (columns + blockSide - 1) / blockSide;
  return std::size_t{texel / columns / blockSide} * blocks + texel % columns / blockSide;
}

/// The plane of elements that face in one direction.
std::optional<Plane> planeOf(const std::vector<SeeingElement>& elements) {
  const SurfacePoint& first = elements.front().centre.point;
  for (const SeeingElement& element : elements)
    if (glm::dot(first.normal, element.centre.point.normal) < 1 - 1e-9) return std::nullopt;
  return Plane{first.normal, glm::dot(first.normal, first.position)};
}

}  // namespace

GatheredRows::GatheredRows(const Scene& scene, const Discretization& discretization, int resolution)
    : scene_(scene), discretization_(discretization), materials_(scene, discretization), resolution_(resolution) {}

bool GatheredRows::isGathered(const Patch& patch) const {
  if (patch.halvings > 0 || materials_.isUnlit(patch.surface)) return false;
  const std::span<const double> first = materials_.emission(patch.surface, patch.elements.front());
  return !areZero(first) && std::all_of(patch.elements.begin(), patch.elements.end(), [&](std::uint32_t element) {
    const std::span<const double> emission = materials_.emission(patch.surface, element);
    return std::equal(emission.begin(), emission.end(), first.begin(), first.end());
  });
}

const std::vector<GatheredRows::Block>& GatheredRows::blocksOf(std::uint32_t surface) {
  if (const auto known = blocks_.find(surface); known != blocks_.end()) return known->second;
  const Grid& grid = discretization_.grids[surface];
  std::vector<Block> blocks(blockOf(grid, static_cast<std::uint32_t>(grid.columns * grid.rows - 1)) + 1);
  for (const std::uint32_t number : elementsOf(grid)) {
    Block& block = blocks[blockOf(grid, discretization_.elements[number].texel)];
    block.elements.push_back(seeingElement(scene_, discretization_, number));
    block.bounds.include(block.elements.back().bounds);
  }
  for (Block& block : blocks)
    if (!block.elements.empty()) block.plane = planeOf(block.elements);
  return blocks_.emplace(surface, std::move(blocks)).first->second;
}

FormFactorRow GatheredRows::gathered(const Patch& patch, const FormFactorRow& drawn) {
  const std::vector<PatchShape> shapes = shapesOf(scene_, discretization_, patch);
  if (shapes.empty()) return drawn;
  if (!tree_) tree_.emplace(scene_);
  const double perElement = gatheredPixels * static_cast<double>(wholeShare) / (3.0 * resolution_ * resolution_);

  // All elements of the surfaces that are seen.
  std::vector<std::uint32_t> elements;
  std::vector<double> shares;
  std::vector<Task> tasks;
  for (std::size_t i = 0; i < drawn.elements.size();) {
    const std::uint32_t surface = discretization_.elements[drawn.elements[i]].surface;
    const Grid& grid = discretization_.grids[surface];
    const std::vector<Block>& blocks = blocksOf(surface);
    const std::size_t first = elements.size();
    for (const std::uint32_t element : elementsOf(grid)) elements.push_back(element);
    shares.resize(elements.size());
    std::vector<double> ofBlock(blocks.size());
    for (; i < drawn.elements.size() && discretization_.elements[drawn.elements[i]].surface == surface; ++i) {
      const std::uint32_t element = drawn.elements[i];
      shares[first + element - grid.firstElement] = static_cast<double>(drawn.shares[i]);
      ofBlock[blockOf(grid, discretization_.elements[element].texel)] += static_cast<double>(drawn.shares[i]);
    }
    for (std::size_t b = 0; b < blocks.size(); ++b)
      if (ofBlock[b] > 0 && ofBlock[b] >= perElement * static_cast<double>(blocks[b].elements.size()))
        tasks.push_back({&blocks[b], first});
  }
  raster::parallelFor(tasks.size(), [&](std::size_t t) { gather(tasks[t], shapes, shares); });

  const double whole = static_cast<double>(wholeShare), sum = std::accumulate(shares.begin(), shares.end(), 0.0),
               elsewhere = static_cast<double>(drawn.background + drawn.back);
  if (!(sum > 0)) return drawn;
  double scale = whole / sum;
  if (elsewhere > 0) scale = std::min(scale, std::clamp((whole - elsewhere) / sum, 1 - mostScaled, 1 + mostScaled));
  for (double& share : shares) share *= scale;
  const double rest = elsewhere > 0 ? (whole - scale * sum) / elsewhere : 0;
  return closedRow(elements, shares, rest * static_cast<double>(drawn.background),
                   rest * static_cast<double>(drawn.back));
}

/// Sets the shares of the elements of a block.
void GatheredRows::gather(const Task& task, const std::vector<PatchShape>& shapes, std::vector<double>& shares) const {
  const Block& block = *task.block;
  std::vector<bool> isClear;
  for (const PatchShape& shape : shapes) {
    std::vector<Plane> planes;
    if (block.plane) planes.push_back(*block.plane);
    if (shape.polygons.size() == 1) planes.push_back(shape.polygons[0].plane);
    isClear.push_back(!tree_->mayBlock(block.bounds, shape.bounds, planes));
  }
  for (const SeeingElement& element : block.elements) {
    double factor = 0;
    for (std::size_t i = 0; i < shapes.size(); ++i)
      factor += formFactorTo(shapes[i], scene_, discretization_, element, *tree_, isClear[i]);
    const Element& receiver = discretization_.elements[element.number];
    const std::size_t place = task.first + element.number - discretization_.grids[receiver.surface].firstElement;
    shares[place] = factor * receiver.area / shapes[0].area * static_cast<double>(wholeShare);
  }
}

}  // namespace hemitex::radiosity
