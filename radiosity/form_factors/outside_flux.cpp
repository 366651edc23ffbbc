#include "radiosity/form_factors/outside_flux.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "radiosity/base/kahan_sum.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/item_buffer_sum.h"
#include "radiosity/projection/parallel_view.h"
#include "radiosity/projection/patch_view.h"
#include "radiosity/scene/ray_tree.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

constexpr int smallestViews = 256, largestViews = 4096;
/// Elements with fewer pixels per view are lit at their centre.
constexpr double minPixels = 0.5;
/// One of this number of directions to the sky lights the centres of small elements.
constexpr int directionsPerRay = 16;
constexpr int directionsPerSunView = 16;

ParallelViews viewsFor(const Scene& scene, const Discretization& discretization, double pixelsPerElement) {
  double area = 0;
  for (const Element& element : discretization.elements) area += element.area;
  const double side = std::sqrt(area / (static_cast<double>(discretization.elements.size()) * pixelsPerElement));
  const BoundingSphere bounds = boundingSphere(scene);
  const double across = std::min(2 * bounds.radius / side, double{largestViews});
  return {bounds, std::clamp(2 * static_cast<int>(across / 2 + 1), smallestViews, largestViews)};
}

/// Whether the back of another face lies on the triangle, at its middle and near its corners. Triangles of the surface
/// `except` are known to have no such back.
bool isCovered(const Scene& scene, const RayTree& rays, const Triangle& triangle, std::uint32_t except) {
  const glm::dvec3 n = normal(triangle);
  const glm::dvec3 middle = (triangle.position[0] + triangle.position[1] + triangle.position[2]) / 3.0;
  const double reach = 2 * contactTolerance(scene);
  const auto above = [&](const glm::dvec3& point) { return point + contactTolerance(scene) * n; };
  const auto isCoveredAt = [&](const glm::dvec3& point) {
    const auto hit = rays.firstHit(above(point), -n, reach);
    return hit && !hit->isFront;
  };
  return rays.meetsBack(above(middle), -n, reach, 0, except) && isCoveredAt(middle) &&
         std::all_of(triangle.position.begin(), triangle.position.end(),
                     [&](const glm::dvec3& p) { return isCoveredAt(glm::mix(p, middle, 0.02)); });
}

/// Whether the normals of a surface differ by less than a right angle, so that no back of it lies on it.
bool facesOneWay(const Surface& surface) {
  constexpr double cosine = 0.71;  // of less than half a right angle
  return std::all_of(surface.triangles.begin(), surface.triangles.end(), [&](const Triangle& triangle) {
    return glm::dot(normal(triangle), normal(surface.triangles.front())) > cosine;
  });
}

/// The triangles that lie under the back of another face, as the bottom of a box under that of a floor. An item buffer
/// would show one or the other by chance.
std::vector<std::uint32_t> coveredTriangles(const Scene& scene, const RayTree& rays) {
  std::vector<std::vector<bool>> areCovered(scene.surfaces.size());
  raster::parallelFor(scene.surfaces.size(), [&](std::size_t s) {
    const Surface& surface = scene.surfaces[s];
    const std::uint32_t except = facesOneWay(surface) ? static_cast<std::uint32_t>(s) : RayTree::noSurface;
    for (const Triangle& triangle : surface.triangles)
      areCovered[s].push_back(isCovered(scene, rays, triangle, except));
  });
  std::vector<std::uint32_t> covered;
  std::uint32_t number = 0;
  for (const std::vector<bool>& ofSurface : areCovered)
    for (const bool is : ofSurface) {
      if (is) covered.push_back(number);
      ++number;
    }
  return covered;
}

/// Draws views against the light and counts their pixels.
class PixelCounts {
 public:
  PixelCounts(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
              raster::ItemBufferRenderer& renderer, const ParallelViews& views, std::vector<std::uint32_t> covered)
      : scene_(scene),
        renderer_(renderer),
        views_(views),
        covered_(std::move(covered)),
        shares_(views.pixelCounts()),
        sum_(discretization, layout) {}

  /// The pixels of all views together, one view per direction.
  FormFactorRow of(std::span<const glm::dvec3> directions) {
    const std::size_t atOnce = hasBacked_ ? 1 : viewsAtOnce();
    return sum_.rowOf(shares_, [&](const AddWindow& add) {
      for (std::size_t first = 0; first < directions.size(); first += atOnce)
        draw(directions, first, std::min(first + atOnce, directions.size()), add);
    });
  }

 private:
  /// As many as fit into 64 MiB, but enough for several threads.
  std::size_t viewsAtOnce() const {
    return static_cast<std::size_t>(std::clamp<std::uint64_t>((1U << 24) / shares_.captured, 2, 16));
  }

  void draw(std::span<const glm::dvec3> directions, std::size_t first, std::size_t end, const AddWindow& add) {
    std::vector<raster::Face> faces;
    for (std::size_t i = first; i < end; ++i)
      faces.push_back(views_.face(scene_.origin, directions[i], static_cast<std::uint32_t>(i)));
    std::vector<std::uint32_t> skipped = covered_;
    if (hasBacked_) {
      const auto away = trianglesFacingAway(scene_, glm::dvec3(faces.front().eye) + scene_.origin, true);
      skipped.clear();
      std::set_union(covered_.begin(), covered_.end(), away.begin(), away.end(), std::back_inserter(skipped));
    }
    renderer_.draw(faces, skipped, buffers_, [&](std::size_t f) { add({0, faces[f].scissor}, buffers_[f]); });
  }

  const Scene& scene_;
  const bool hasBacked_ = std::any_of(scene_.surfaces.begin(), scene_.surfaces.end(),
                                      [](const Surface& surface) { return hasBacked(surface); });
  raster::ItemBufferRenderer& renderer_;
  ParallelViews views_;
  std::vector<std::uint32_t> covered_;
  Projection shares_;
  ItemBufferSum sum_;
  std::vector<raster::ItemBuffer> buffers_;
};

/// Directions of the same light, and the irradiance of each on a plane at right angles to it.
struct Beams {
  std::vector<glm::dvec3> directions;
  Bands irradiance;
};

/// A plane faces half of the directions, with a mean cosine of a half.
Beams skyBeams(const Scene& scene, int count) {
  return {sphereDirections(count), lightInBands(scene, scene.outside.sky * (4.0 / count))};
}

Beams sunBeams(const Scene& scene, const Sun& sun, int count) {
  return {std::vector<glm::dvec3>(static_cast<std::size_t>(count), sun.towards),
          lightInBands(scene, sun.irradiance / double(count))};
}

/// Lights the centres of elements.
class CentreLight {
 public:
  CentreLight(const Scene& scene, const Discretization& discretization, const RayTree& rays, int directions)
      : scene_(scene), discretization_(discretization), rays_(rays), lights_{skyBeams(scene, directions)} {
    for (const Sun& sun : scene.outside.suns) lights_.push_back(sunBeams(scene, sun, 1));
  }

  Bands irradiance(std::uint32_t element) const {
    const std::uint32_t surface = discretization_.elements[element].surface;
    const SurfacePoint point = elementCentre(scene_, discretization_, element);
    const glm::dvec3 start = eyeOver(scene_, surface, point);
    Bands sum(bandCount(scene_));
    for (const Beams& light : lights_) {
      double cosines = 0;
      for (const glm::dvec3& direction : light.directions) {
        const double cosine = glm::dot(point.normal, direction);
        if (cosine > 0 && !rays_.isBlocked(start, direction, std::numeric_limits<double>::infinity()))
          cosines += cosine;
      }
      addTo(sum, light.irradiance, cosines);
    }
    return sum;
  }

 private:
  const Scene& scene_;
  const Discretization& discretization_;
  const RayTree& rays_;
  std::vector<Beams> lights_;
};

/// Replaces the flux of elements that are small against a pixel of this area.
void lightCentres(const CentreLight& light, const Discretization& discretization, double pixelArea, OutsideFlux& flux) {
  raster::parallelFor(discretization.elements.size(), [&](std::size_t e) {
    const double area = discretization.elements[e].area;
    if (area < minPixels * pixelArea)
      set(flux.received[e], scaled(light.irradiance(static_cast<std::uint32_t>(e)), area));
  });
}

/// Throws InputError if a sun lights a mirror image in another way than the surfaces.
void requireEqualSuns(const Scene& scene) {
  for (const Instance& instance : scene.instances)
    for (const Sun& sun : scene.outside.suns)
      if (instance.sign * sun.towards != sun.towards)
        throw raster::InputError(
            "a sun lights the images behind a mirror plane in another way than the surfaces in front of it",
            "choose a direction along the plane, or omit the mirror");
}

}  // namespace

Bands sumOf(const OutsideFlux& flux) {
  KahanSum sum(flux.received.bands);
  for (std::size_t e = 0; e < flux.received.size(); ++e) sum.add(flux.received[e]);
  sum.add(flux.lost);
  return sum.sum;
}

void addLamp(OutsideFlux& flux, std::size_t elements, const FormFactorRow& row, const Bands& emitted) {
  if (flux.received.empty()) flux.received = BandTable(elements, emitted.size());
  for (Bands* sum : {&flux.fromLamps, &flux.lost, &flux.lostToBacks}) sum->resize(emitted.size());
  for (std::size_t i = 0; i < row.elements.size(); ++i)
    addTo(flux.received[row.elements[i]], emitted, formFactor(row.shares[i]));
  addTo(flux.fromLamps, emitted);
  addTo(flux.lost, emitted, formFactor(row.background + row.back));
  addTo(flux.lostToBacks, emitted, formFactor(row.back));
}

OutsideViews affordableViews(int directions, std::size_t triangles) {
  constexpr std::size_t maxDrawn = std::size_t{5} << 24;
  const auto affordable = static_cast<int>(std::min(maxDrawn / std::max<std::size_t>(triangles, 1), maxDrawn));
  OutsideViews views;
  views.directions = std::max(std::min(directions, affordable), minDirections);
  const double fewer = std::max(static_cast<double>(directions) / views.directions, 1.0);
  views.pixelsPerElement *= std::sqrt(fewer * std::sqrt(fewer));
  return views;
}

OutsideFlux outsideFlux(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                        raster::ItemBufferRenderer& renderer, const OutsideViews& drawn) {
  if (!(brightest(scene.outside) > 0)) return {};
  requireEqualSuns(scene);
  OutsideFlux flux{BandTable(discretization.elements.size(), bandCount(scene)), Bands(bandCount(scene))};
  const ParallelViews views = viewsFor(scene, discretization, drawn.pixelsPerElement);
  const double pixelArea = views.pixelSide() * views.pixelSide();
  const RayTree rays(scene);
  PixelCounts pixels(scene, discretization, layout, renderer, views,
                     !hasBacks(scene) ? std::vector<std::uint32_t>() : coveredTriangles(scene, rays));
  const auto add = [&](const Beams& light) {
    if (areZero(light.irradiance)) return;
    const FormFactorRow counts = pixels.of(light.directions);
    const Bands perPixel = scaled(light.irradiance, pixelArea);
    for (std::size_t i = 0; i < counts.elements.size(); ++i)
      addTo(flux.received[counts.elements[i]], perPixel, static_cast<double>(counts.shares[i]));
    addTo(flux.onBacks, perPixel, static_cast<double>(counts.back));
  };
  add(skyBeams(scene, drawn.directions));
  for (const Sun& sun : scene.outside.suns)
    add(sunBeams(scene, sun, std::max(drawn.directions / directionsPerSunView, 1)));
  lightCentres(CentreLight(scene, discretization, rays, std::max(drawn.directions / directionsPerRay, 1)),
               discretization, pixelArea, flux);
  return flux;
}

}  // namespace hemitex::radiosity
