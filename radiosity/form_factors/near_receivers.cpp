#include "radiosity/form_factors/near_receivers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <tuple>

#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Small elements have at most this share of the mean area of elements.
constexpr double smallShare = 0.5;
/// Lamps have at most this share of all area. Where walls emit, as in a furnace, all patches would be lamps.
constexpr double lampShare = 0.1;
/// Maximum number of small elements.
constexpr std::size_t maxSmall = 1 << 13;
/// A small element is tested if its share in the row of the patch, which may be too small, gives at least this form
/// factor from the element to the patch.
constexpr double testedShare = nearShare / 16;
/// An element is near a lamp up to this number of sizes of the part that a point shoots for.
constexpr double nearSizes = 2;
/// Parts of more triangles, as those of cut-outs, keep what was drawn: the time grows with the product of both numbers.
constexpr std::size_t maxFaces = 128;
/// Rays between an element and a patch.
constexpr std::size_t raysOfLamp = 64, raysOfSmall = 32;

/// The small elements; only the smallest ones if there are more than `maxSmall`.
std::vector<bool> smallElements(const std::vector<Element>& elements) {
  double area = 0;
  for (const Element& element : elements) area += element.area;
  const double limit = smallShare * area / static_cast<double>(elements.size());
  std::vector<std::uint32_t> small;
  for (std::uint32_t e = 0; e < elements.size(); ++e)
    if (elements[e].area <= limit) small.push_back(e);
  const std::size_t count = std::min(small.size(), maxSmall);
  std::nth_element(small.begin(), small.begin() + static_cast<std::ptrdiff_t>(count), small.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::tuple(elements[a].area, a) < std::tuple(elements[b].area, b);
                   });
  std::vector<bool> isSmall(elements.size());
  for (std::size_t i = 0; i < count; ++i) isSmall[small[i]] = true;
  return isSmall;
}

std::vector<Bounds> boundsOfSurfaces(const Scene& scene) {
  std::vector<Bounds> bounds(scene.surfaces.size());
  for (std::size_t s = 0; s < bounds.size(); ++s)
    for (const Triangle& triangle : scene.surfaces[s].triangles) bounds[s].include(triangle);
  return bounds;
}

double distanceTo(const std::vector<SurfacePart>& shapes, const Bounds& bounds) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const SurfacePart& shape : shapes) smallest = std::min(smallest, distanceBetween(shape.bounds, bounds));
  return smallest;
}

/// A row with other shares for some entries, below 0 for those that stay. What misses all elements stays as well. What
/// remains for the other elements is known well only where it is not the small rest of all: it is from half to twice of
/// what was drawn.
FormFactorRow replaced(const FormFactorRow& row, const std::vector<double>& others) {
  const double missed = static_cast<double>(row.background) + static_cast<double>(row.back);
  double sum = missed, drawn = 0;
  for (std::size_t i = 0; i < others.size(); ++i)
    (others[i] < 0 ? drawn : sum) += others[i] < 0 ? static_cast<double>(row.shares[i]) : others[i];
  const double scale = drawn > 0 ? std::clamp((static_cast<double>(wholeShare) - sum) / drawn, 0.5, 2.0) : 1;
  std::vector<double> shares;
  for (std::size_t i = 0; i < others.size(); ++i)
    shares.push_back(others[i] < 0 ? scale * static_cast<double>(row.shares[i]) : others[i]);
  return closedRow(row.elements, shares, static_cast<double>(row.background), static_cast<double>(row.back));
}

}  // namespace

NearReceivers::NearReceivers(const Scene& scene, const Discretization& discretization)
    : scene_(scene),
      discretization_(discretization),
      materials_(scene, discretization),
      isSmall_(smallElements(discretization.elements)),
      ofSurfaces_(boundsOfSurfaces(scene)) {
  double all = 0, emitting = 0;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    const Element& element = discretization.elements[e];
    all += element.area;
    if (!areZero(materials_.emission(element.surface, e))) emitting += element.area;
  }
  areLampsSmall_ = emitting <= lampShare * all;
}

std::optional<FormFactorRow> NearReceivers::corrected(const Patch& patch, const FormFactorRow& row) {
  known_.set(patch.number, NearRows::State::Drawn);
  const SurfacePart part = partOf(scene_, discretization_, patch);
  if (!(part.area > 0) || part.faces.size() > maxFaces) return std::nullopt;
  std::vector<SurfacePart> shapes;
  for (const Instance& instance : scene_.instances) shapes.push_back(placed(part, instance));
  const std::vector<Candidate> candidates = this->candidates(patch, row, shapes);
  if (candidates.empty()) return std::nullopt;
  if (!tree_) tree_.emplace(scene_);
  // Images of a patch add up. Those that are left out have less than a hundredth of the least sum.
  const double ofImage = shapes.size() > 1 ? 0.02 / static_cast<double>(shapes.size()) : 1;
  std::vector<double> others(row.shares.size(), -1);
  raster::parallelFor(candidates.size(), [&](std::size_t c) {
    const auto& [entry, element, least] = candidates[c];
    double area = 0;
    const NearAccuracy accuracy{ofImage * least * element->area, contactTolerance(scene_),
                                least > 0 ? raysOfSmall : raysOfLamp};
    for (const SurfacePart& shape : shapes) area += exchangeArea(*element, shape, *tree_, accuracy);
    const double factor = area / element->area;
    if (factor > 0 && factor >= least)
      others[entry] =
          factor * discretization_.elements[row.elements[entry]].area / part.area * static_cast<double>(wholeShare);
  });
  if (std::all_of(others.begin(), others.end(), [](double share) { return share < 0; })) return std::nullopt;
  known_.set(patch.number, NearRows::State::Corrected);
  return replaced(row, others);
}

std::vector<NearReceivers::Candidate> NearReceivers::candidates(const Patch& patch, const FormFactorRow& row,
                                                                const std::vector<SurfacePart>& shapes) {
  std::vector<Candidate> result;
  const double reach = isLamp(patch) ? nearSizes * shapes.front().size() / patch.points : -1;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const std::uint32_t number = row.elements[i];
    const Element& element = discretization_.elements[number];
    const bool isSmall = isSmall_[number] && element.area * patch.points * patch.points <= patch.area &&
                         formFactor(row.shares[i]) * patch.area / element.area >= testedShare;
    const bool mayBeNear = reach > 0 && distanceTo(shapes, ofSurfaces_[element.surface]) <= reach;
    if ((!isSmall && !mayBeNear) || std::binary_search(patch.elements.begin(), patch.elements.end(), number)) continue;
    const SurfacePart& part = partOfElement(number);
    if (!(part.area > 0) || part.faces.size() > maxFaces) continue;
    const bool isNear = mayBeNear && distanceTo(shapes, part.bounds) <= reach;
    if (isSmall || isNear) result.push_back({i, &part, isNear ? 0 : nearShare});
  }
  return result;
}

bool NearReceivers::isLamp(const Patch& patch) const {
  return areLampsSmall_ && std::any_of(patch.elements.begin(), patch.elements.end(), [&](std::uint32_t element) {
           return !areZero(materials_.emission(patch.surface, element));
         });
}

const SurfacePart& NearReceivers::partOfElement(std::uint32_t element) {
  auto found = ofElements_.find(element);
  if (found == ofElements_.end()) found = ofElements_.emplace(element, partOf(scene_, discretization_, element)).first;
  return found->second;
}

/// F_ep is at most A_p / (pi d^2) at the distance d of the patch. Twice that, because patches may be up to 40 times as
/// long as wide.
double NearReceivers::distanceOf(const Patch& patch) {
  return std::max(2 * std::sqrt(patch.area / (std::numbers::pi * nearShare)),
                  (nearSizes + 1) * partOf(scene_, discretization_, patch).size());
}

}  // namespace hemitex::radiosity
