#include "radiosity/form_factors/near_receivers.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "radiosity/discretization/patch_points.h"

namespace hemitex::radiosity {
namespace {

/// Resolution of the hemicubes over small elements.
constexpr int nearResolution = 64;
/// Small elements have at most this share of the mean area of elements.
constexpr double smallShare = 0.5;
/// Maximum number of small elements, and of the triangles that all their hemicubes draw.
constexpr std::size_t maxSmall = 1 << 13, maxDrawn = std::size_t{1} << 26;
/// An element is tested if its share in the row of the patch, which may be too small, gives at least this form factor
/// from the element to the patch.
constexpr double testedShare = nearShare / 16;

std::vector<bool> smallElements(const Scene& scene, const std::vector<Element>& elements) {
  double area = 0;
  for (const Element& element : elements) area += element.area;
  const double limit = smallShare * area / static_cast<double>(elements.size());
  std::vector<std::uint32_t> small;
  for (std::uint32_t e = 0; e < elements.size(); ++e)
    if (elements[e].area <= limit) small.push_back(e);
  const std::size_t count =
      std::min({small.size(), maxSmall, maxDrawn / std::max<std::size_t>(1, placedTriangleCount(scene))});
  std::nth_element(small.begin(), small.begin() + static_cast<std::ptrdiff_t>(count), small.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     return std::tuple(elements[a].area, a) < std::tuple(elements[b].area, b);
                   });
  std::vector<bool> isSmall(elements.size());
  for (std::size_t i = 0; i < count; ++i) isSmall[small[i]] = true;
  return isSmall;
}

}  // namespace

double nearDistanceOf(const Patch& patch) { return 2 * std::sqrt(patch.area / (std::numbers::pi * nearShare)); }

NearReceivers::NearReceivers(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                             raster::ItemBufferRenderer& renderer)
    : scene_(scene),
      discretization_(discretization),
      rows_(scene, discretization, layout, renderer, {.resolution = nearResolution}),
      isSmall_(smallElements(scene, discretization.elements)) {}

std::optional<FormFactorRow> NearReceivers::corrected(const Patch& patch, const FormFactorRow& row) {
  std::vector<double> shares(row.shares.begin(), row.shares.end());
  bool isChanged = false;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const std::uint32_t element = row.elements[i];
    const double area = discretization_.elements[element].area, ratio = patch.area / area;
    if (!isSmall_[element] || area * patch.points * patch.points > patch.area) continue;
    if (formFactor(row.shares[i]) * ratio < testedShare) continue;
    const double factor = factorTo(patch, element);
    if (factor < nearShare) continue;
    shares[i] = factor / ratio * static_cast<double>(wholeShare);
    isChanged = true;
  }
  known_.set(patch.number, isChanged ? NearRows::State::Corrected : NearRows::State::Drawn);
  if (!isChanged) return std::nullopt;
  return closedRow(row.elements, shares, static_cast<double>(row.background), static_cast<double>(row.back));
}

View NearReceivers::viewFrom(std::uint32_t element) {
  const SurfacePoint centre = elementCentre(scene_, discretization_, element);
  return rows_.viewFrom({.surface = discretization_.elements[element].surface,
                         .point = centre,
                         .up = upOf(Orientation::Turned, centre.normal, element, 0)});
}

/// The form factor from an element to a patch.
double NearReceivers::factorTo(const Patch& patch, std::uint32_t element) {
  auto found = known_.ofElements.find(element);
  if (found == known_.ofElements.end())
    found = known_.ofElements.emplace(element, rows_.ofView(viewFrom(element))).first;
  const FormFactorRow& row = found->second;
  std::uint64_t share = 0;
  auto at = row.elements.begin();
  for (const std::uint32_t other : patch.elements) {
    at = std::lower_bound(at, row.elements.end(), other);
    if (at == row.elements.end()) break;
    if (*at == other) share += row.shares[static_cast<std::size_t>(at - row.elements.begin())];
  }
  return formFactor(share);
}

}  // namespace hemitex::radiosity
