#include "tests/truth/traced_picture.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "radiosity/pictures/camera.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/pictures/visibility.h"
#include "raster/base/parallel.h"
#include "reference/truth/rays/ray_caster.h"

namespace hemitex::tests {
namespace {

using std::numbers::pi;

constexpr double maxSurvival = 0.95;
constexpr std::uint32_t noTriangle = ~0U;

/// A triangle in space, in the frame of the scene.
struct Place {
  radiosity::TrianglePlace place;
  std::array<glm::dvec3, 3> corner;
  glm::dvec3 normal, emission;
  double area, upTo;  ///< `upTo`: cumulative share of the emitted flux
};

/// Uniform numbers in (0, 1).
class Random {
 public:
  explicit Random(std::uint32_t seed) : random_(seed) {}
  double next() { return (static_cast<double>(random_()) + 0.5) * 0x1p-32; }
  glm::dvec2 pair() {
    const double x = next();
    return {x, next()};
  }
  /// side x side points of the unit square, one in each cell, in random order.
  std::vector<glm::dvec2> cells(int side) {
    std::vector<glm::dvec2> points;
    for (int k = 0; k < side * side; ++k) points.push_back((glm::dvec2(k % side, k / side) + pair()) / double(side));
    for (std::size_t k = points.size(); k > 1; --k)
      std::swap(points[k - 1], points[std::min(k - 1, static_cast<std::size_t>(next() * static_cast<double>(k)))]);
    return points;
  }

 private:
  std::mt19937 random_;
};

class PathTracer {
 public:
  explicit PathTracer(const radiosity::Scene& scene) : scene_(scene), caster_(scene) {
    double sum = 0;
    radiosity::forEachPlace(scene, [&](const radiosity::TrianglePlace& place) {
      std::array<glm::dvec3, 3> corner = radiosity::placedCorners(scene, place);
      for (glm::dvec3& c : corner) c = (c - scene.origin) / scene.extent;
      const glm::dvec3 cross = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
      const glm::dvec3 emission =
          scene.materials[static_cast<std::size_t>(scene.surfaces[place.surface].material)].emission;
      const double area = glm::length(cross) / 2;
      sum += area * radiosity::bandSum(emission);
      places_.push_back({place, corner, cross / (2 * area), emission, area, sum});
    });
    for (Place& place : places_) place.upTo /= sum;
    flux_ = sum;
  }

  /// The radiosity that a ray of the camera meets, with the random numbers of its first front.
  glm::dvec3 seen(glm::dvec3 start, const glm::dvec3& direction, const glm::dvec2& lamp, const glm::dvec2& way,
                  Random& random) const {
    std::uint32_t from = noTriangle;
    for (;;) {
      const auto hit = caster_.firstHit({start, direction, from});
      if (!hit) return glm::dvec3(0);
      if (hit->front) return places_[hit->triangle].emission + reflected(*hit, lamp, way, random);
      start = positionOf(*hit);
      from = hit->triangle;
    }
  }

 private:
  glm::dvec3 positionOf(const reference::RayHit& hit) const {
    const auto& [a, b, c] = places_[hit.triangle].corner;
    return a + hit.weights.x * (b - a) + hit.weights.y * (c - a);
  }

  glm::dvec3 reflectance(const reference::RayHit& hit) const {
    const radiosity::TrianglePlace& place = places_[hit.triangle].place;
    const double x = hit.weights.x, y = hit.weights.y;
    return radiosity::unlitColour(scene_, {place.surface, place.triangle, {1 - x - y, x, y}, place.instance});
  }

  /// Density of the points of a lamp as directions from a point: that of the flux, per steradian.
  double lampDensity(const Place& lamp, double distanceSquared, double cosine) const {
    return radiosity::bandSum(lamp.emission) / flux_ * distanceSquared / cosine;
  }

  /// The irradiance from one random point of the lamps, weighted.
  glm::dvec3 fromLamps(const glm::dvec3& at, const glm::dvec3& normal, std::uint32_t triangle, double choice, double y,
                       double z) const {
    if (flux_ == 0) return glm::dvec3(0);
    const auto lamp = std::lower_bound(places_.begin(), std::prev(places_.end()), choice,
                                       [](const Place& place, double value) { return place.upTo < value; });
    const double root = std::sqrt(y);
    const auto& [a, b, c] = lamp->corner;
    const glm::dvec3 way = (1 - root) * a + root * (1 - z) * b + root * z * c - at;
    const double square = glm::dot(way, way);
    const glm::dvec3 direction = way / std::sqrt(square);
    const double here = glm::dot(direction, normal), there = -glm::dot(direction, lamp->normal);
    if (!(here > 0 && there > 0)) return glm::dvec3(0);
    const auto hit = caster_.firstHit({at, direction, triangle});
    if (!hit || !hit->front || hit->triangle != static_cast<std::uint32_t>(lamp - places_.begin()))
      return glm::dvec3(0);
    return lamp->emission * (here / pi / (lampDensity(*lamp, square, there) + here / pi));
  }

  /// The reflected radiosity at a front.
  glm::dvec3 reflected(reference::RayHit hit, glm::dvec2 lamp, glm::dvec2 way, Random& random) const {
    glm::dvec3 sum(0), share(1);
    for (;;) {
      const glm::dvec3 at = positionOf(hit), normal = places_[hit.triangle].normal;
      share *= reflectance(hit);
      const double y = random.next();
      sum += share * fromLamps(at, normal, hit.triangle, lamp.x, y, lamp.y);

      const glm::dvec3 axis = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
      const glm::dvec3 right = glm::normalize(glm::cross(axis, normal)), up = glm::cross(normal, right);
      const double radius = std::sqrt(way.x), angle = 2 * pi * way.y, cosine = std::sqrt(1 - way.x);
      const glm::dvec3 direction = radius * std::cos(angle) * right + radius * std::sin(angle) * up + cosine * normal;
      const auto next = caster_.firstHit({at, direction, hit.triangle});
      if (!next || !next->front) return sum;
      const Place& met = places_[next->triangle];
      if (radiosity::bandSum(met.emission) > 0) {
        const glm::dvec3 line = positionOf(*next) - at;
        const double there = std::max(-glm::dot(direction, met.normal), 1e-12);
        sum += share * met.emission * (cosine / pi / (cosine / pi + lampDensity(met, glm::dot(line, line), there)));
      }
      const double survival = std::min(maxSurvival, std::max({share.r, share.g, share.b}));
      if (random.next() >= survival) return sum;
      share /= survival;
      hit = *next;
      lamp = random.pair();
      way = random.pair();
    }
  }

  const radiosity::Scene& scene_;
  reference::RayCaster caster_;
  std::vector<Place> places_;
  double flux_ = 0;  ///< sum of the bands, in squares of the extent
};

}  // namespace

radiosity::Image tracedPicture(const radiosity::Scene& scene, const radiosity::SceneCamera& camera, int width,
                               int height, int side, std::uint32_t seed) {
  const PathTracer tracer(scene);
  const radiosity::CameraAxes axes = radiosity::axesOf(camera);
  const double pixel = 2 * std::tan(camera.fov * pi / 360) / height;
  const glm::dvec3 eye = (camera.eye - scene.origin) / scene.extent;
  radiosity::Image image{width, height, std::vector<glm::dvec3>(static_cast<std::size_t>(width * height))};
  raster::parallelFor(static_cast<std::size_t>(height), [&](std::size_t row) {
    Random random(seed * 65536 + static_cast<std::uint32_t>(row));
    for (int column = 0; column < width; ++column) {
      const auto places = random.cells(side), lamps = random.cells(side), ways = random.cells(side);
      glm::dvec3 sum(0);
      for (std::size_t k = 0; k < places.size(); ++k) {
        const double x = pixel * (column + places[k].x - width / 2.0);
        const double y = pixel * (height / 2.0 - static_cast<double>(row) - places[k].y);
        sum += tracer.seen(eye, glm::normalize(axes.forward + x * axes.right + y * axes.up), lamps[k], ways[k], random);
      }
      image.pixels[row * static_cast<std::size_t>(width) + static_cast<std::size_t>(column)] =
          sum / static_cast<double>(places.size());
    }
  });
  return image;
}

PictureDifference differenceOf(const radiosity::Image& a, const radiosity::Image& b) {
  std::vector<double> differences;
  for (std::size_t p = 0; p < a.pixels.size(); ++p) {
    double sum = 0;
    for (int band = 0; band < 3; ++band)
      sum += std::abs(radiosity::encodeSrgb(a.pixels[p][band]) - radiosity::encodeSrgb(b.pixels[p][band]));
    differences.push_back(sum / (3 * 255));
  }
  std::sort(differences.begin(), differences.end());
  const double mean = std::accumulate(differences.begin(), differences.end(), 0.0) / double(differences.size());
  return {mean, differences[differences.size() * 99 / 100]};
}

}  // namespace hemitex::tests
