#include "radiosity/form_factors/outside_flux.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/item_buffer_sum.h"
#include "radiosity/geometry/ray_tree.h"
#include "radiosity/projection/parallel_view.h"
#include "radiosity/projection/patch_view.h"
#include "radiosity/projection/sphere_directions.h"
#include "radiosity/solver/kahan_sum.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Pixels of a view for an element of mean area that faces the light.
constexpr double pixelsPerElement = 16;
constexpr int smallestViews = 256, largestViews = 4096;
/// Elements with fewer pixels per view are lit at their centre.
constexpr double minPixels = 0.5;
/// One of this number of directions to the sky lights the centres of small elements.
constexpr int directionsPerRay = 4;
constexpr int directionsPerSunView = 8;

ParallelViews viewsFor(const Scene& scene, const Discretization& discretization) {
  double area = 0;
  for (const Element& element : discretization.elements) area += element.area;
  const double side = std::sqrt(area / (static_cast<double>(discretization.elements.size()) * pixelsPerElement));
  const BoundingSphere bounds = boundingSphere(scene);
  const double across = std::min(2 * bounds.radius / side, double{largestViews});
  return {bounds, std::clamp(2 * static_cast<int>(across / 2 + 1), smallestViews, largestViews)};
}

/// Draws views against the light and counts their pixels.
class PixelCounts {
 public:
  PixelCounts(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
              raster::ItemBufferRenderer& renderer, const ParallelViews& views)
      : scene_(scene), renderer_(renderer), views_(views), shares_(views.pixelCounts()), sum_(discretization, layout) {}

  /// The pixels of all views together, one view per direction.
  FormFactorRow of(std::span<const glm::dvec3> directions) {
    const bool isTwoSided = scene_.surfaces.front().twin.has_value();
    const std::size_t atOnce = isTwoSided ? 1 : viewsAtOnce();
    for (std::size_t first = 0; first < directions.size(); first += atOnce)
      draw(directions, first, std::min(first + atOnce, directions.size()));
    return sum_.takeRow();
  }

 private:
  /// As many as fit into 64 MiB, but enough for several threads.
  std::size_t viewsAtOnce() const {
    return std::clamp(std::size_t{1 << 24} / shares_.captured, std::size_t{2}, std::size_t{16});
  }

  void draw(std::span<const glm::dvec3> directions, std::size_t first, std::size_t end) {
    std::vector<raster::Face> faces;
    for (std::size_t i = first; i < end; ++i)
      faces.push_back(views_.face(scene_.origin, directions[i], static_cast<std::uint32_t>(i)));
    const std::vector<std::uint32_t> hidden = hiddenSides(scene_, glm::dvec3(faces.front().eye) + scene_.origin);
    const Window window = wholeFaces(shares_).front();
    renderer_.draw(faces, hidden, buffers_, [&](std::size_t f) { sum_.add(shares_, window, buffers_[f]); });
  }

  const Scene& scene_;
  raster::ItemBufferRenderer& renderer_;
  ParallelViews views_;
  Projection shares_;
  ItemBufferSum sum_;
  std::vector<raster::ItemBuffer> buffers_;
};

/// Directions of the same light, and the irradiance of each on a plane at right angles to it.
struct Beams {
  std::vector<glm::dvec3> directions;
  glm::dvec3 irradiance{0.0};
};

/// A plane faces half of the directions, with a mean cosine of a half.
Beams skyBeams(const glm::dvec3& irradiance, int count) { return {sphereDirections(count), irradiance * (4.0 / count)}; }

Beams sunBeams(const Sun& sun, int count) {
  return {std::vector<glm::dvec3>(static_cast<std::size_t>(count), sun.towards), sun.irradiance / double(count)};
}

/// Lights the centres of elements.
class CentreLight {
 public:
  CentreLight(const Scene& scene, int directions)
      : scene_(scene), rays_(scene), lights_{skyBeams(scene.outside.sky, directions)} {
    for (const Sun& sun : scene.outside.suns) lights_.push_back(sunBeams(sun, 1));
  }

  glm::dvec3 irradiance(const Discretization& discretization, std::uint32_t element) const {
    const std::uint32_t surface = discretization.elements[element].surface;
    const SurfacePoint point = elementCentre(scene_, discretization, element);
    const glm::dvec3 start = eyeOver(scene_, surface, point);
    glm::dvec3 sum(0);
    for (const Beams& light : lights_) {
      double cosines = 0;
      for (const glm::dvec3& direction : light.directions) {
        const double cosine = glm::dot(point.normal, direction);
        if (cosine > 0 && !rays_.firstHit(start, direction)) cosines += cosine;
      }
      sum += light.irradiance * cosines;
    }
    return sum;
  }

 private:
  const Scene& scene_;
  RayTree rays_;
  std::vector<Beams> lights_;
};

/// Replaces the flux of elements that are small against a pixel of this area.
void lightCentres(const Scene& scene, const Discretization& discretization, double pixelArea, int directions,
                  OutsideFlux& flux) {
  std::vector<std::uint32_t> small;
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
    if (discretization.elements[e].area < minPixels * pixelArea) small.push_back(e);
  if (small.empty()) return;
  const CentreLight light(scene, std::max(directions / directionsPerRay, 1));
  raster::parallelFor(small.size(), [&](std::size_t i) {
    flux.received[small[i]] = light.irradiance(discretization, small[i]) * discretization.elements[small[i]].area;
  });
}

}  // namespace

glm::dvec3 sumOf(const OutsideFlux& flux) {
  KahanSum sum;
  for (const glm::dvec3& received : flux.received) sum.add(received);
  return sum.value();
}

OutsideFlux outsideFlux(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                        raster::ItemBufferRenderer& renderer, int directions) {
  OutsideFlux flux;
  if (!(brightest(scene.outside) > 0)) return flux;
  flux.received.resize(discretization.elements.size());
  const ParallelViews views = viewsFor(scene, discretization);
  const double pixelArea = views.pixelSide() * views.pixelSide();
  PixelCounts pixels(scene, discretization, layout, renderer, views);
  const auto add = [&](const Beams& light) {
    if (light.irradiance == glm::dvec3(0)) return;
    const FormFactorRow counts = pixels.of(light.directions);
    const glm::dvec3 perPixel = light.irradiance * pixelArea;
    for (std::size_t i = 0; i < counts.elements.size(); ++i)
      flux.received[counts.elements[i]] += perPixel * static_cast<double>(counts.shares[i]);
    flux.onBacks += perPixel * static_cast<double>(counts.back);
  };
  add(skyBeams(scene.outside.sky, directions));
  for (const Sun& sun : scene.outside.suns) add(sunBeams(sun, std::max(directions / directionsPerSunView, 1)));
  lightCentres(scene, discretization, pixelArea, directions, flux);
  return flux;
}

}  // namespace hemitex::radiosity
