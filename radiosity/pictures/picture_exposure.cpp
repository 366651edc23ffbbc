#include "radiosity/pictures/picture_exposure.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>
#include <optional>
#include <vector>

#include "radiosity/pictures/pictures.h"

namespace hemitex::radiosity {
namespace {

constexpr int longerSide = 256;  ///< of the picture, in pixels
constexpr double middleGrey = 0.18;
constexpr std::size_t clippedOneIn = 100;

/// The elements of the pixels that show a surface.
std::vector<std::uint32_t> seenElements(const Scene& scene, const Discretization& discretization, const Camera& camera,
                                        int width, int height) {
  const int longer = std::max(width, height);
  const auto reduced = [&](int side) { return std::max(1, side * longerSide / longer); };
  std::vector<std::uint32_t> elements;
  for (const std::optional<Visible>& visible : visibleSamples(scene, camera, reduced(width), reduced(height)))
    if (visible) elements.push_back(elementAt(scene, discretization, *visible));
  return elements;
}

/// The value with `above` others that are not below it.
double fromTop(std::vector<double> values, std::size_t above) {
  const auto place = values.end() - 1 - static_cast<std::ptrdiff_t>(above);
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// The exposure for pixels of these elements; nothing if none of them has light.
std::optional<double> exposureFor(const std::vector<std::uint32_t>& elements, const ElementValues& radiosity) {
  std::vector<double> means, maxima;  // over bands
  for (const std::uint32_t element : elements) {
    const glm::dvec3 b = radiosity(element);
    if (!(bandSum(b) > 0)) continue;
    means.push_back(bandSum(b) / 3);
    maxima.push_back(glm::max(b.r, glm::max(b.g, b.b)));
  }
  if (means.empty()) return std::nullopt;
  const double median = fromTop(means, means.size() / 2), highlight = fromTop(maxima, maxima.size() / clippedOneIn);
  return std::min(middleGrey / median, 1 / highlight);
}

}  // namespace

double pictureExposure(const Scene& scene, const Discretization& discretization, const ElementValues& radiosity,
                       const Camera& camera, int width, int height) {
  const std::vector<std::uint32_t> seen = seenElements(scene, discretization, camera, width, height);
  std::vector<std::uint32_t> lit, all(discretization.elements.size());
  std::copy_if(seen.begin(), seen.end(), std::back_inserter(lit),
               [&](std::uint32_t e) { return emission(scene, discretization, e) == glm::dvec3(0.0); });
  std::iota(all.begin(), all.end(), 0u);
  for (const auto& elements : {std::cref(lit), std::cref(seen), std::cref(all)})
    if (const std::optional<double> exposure = exposureFor(elements, radiosity)) return *exposure;
  return 1;
}

}  // namespace hemitex::radiosity
