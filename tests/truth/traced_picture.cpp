#include "tests/truth/traced_picture.h"

#include <algorithm>
#include <cmath>
#include <limits>
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
  double density = 0, upTo = 0;  ///< of the points of lamps: per area here; the share of this and all triangles before
};

glm::dvec3 crossOf(const std::array<glm::dvec3, 3>& corner) {
  return glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
}
double areaOf(const std::array<glm::dvec3, 3>& corner) { return glm::length(crossOf(corner)) / 2; }

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
    std::vector<double> fluxOf(scene.materials.size());
    radiosity::forEachPlace(scene, [&](const radiosity::TrianglePlace& place) {
      std::array<glm::dvec3, 3> corner = radiosity::placedCorners(scene, place);
      for (glm::dvec3& c : corner) c = (c - scene.origin) / scene.extent;
      const auto material = static_cast<std::size_t>(scene.surfaces[place.surface].material);
      const glm::dvec3& emission = scene.materials[material].emission;
      places_.push_back({place, corner, glm::normalize(crossOf(corner)), emission});
      fluxOf[material] += areaOf(corner) * radiosity::bandSum(emission);
    });
    const double flux = std::accumulate(fluxOf.begin(), fluxOf.end(), 0.0);
    const auto lamps = std::count_if(fluxOf.begin(), fluxOf.end(), [](double value) { return value > 0; });
    // Half of the points by flux, and half of them equally for each material, so that small lamps have enough.
    for (Place& place : places_)
      if (const double emitted = radiosity::bandSum(place.emission); emitted > 0) {
        const double ofMaterial = fluxOf[static_cast<std::size_t>(scene.surfaces[place.place.surface].material)];
        place.density = emitted / 2 * (1 / flux + 1 / (static_cast<double>(lamps) * ofMaterial));
      }
    double sum = 0;
    for (Place& place : places_) place.upTo = sum += areaOf(place.corner) * place.density;
    for (Place& place : places_) place.upTo /= sum;
    hasLamps_ = sum > 0;
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

  struct Vertex {
    glm::dvec3 position, normal;
    std::uint32_t triangle;
    glm::dvec3 reflectance;
  };
  Vertex vertexOf(const reference::RayHit& hit) const {
    return {positionOf(hit), places_[hit.triangle].normal, hit.triangle, reflectance(hit)};
  }

  /// The density of y per area, as the end of a cosine-distributed ray from x; 0 if one does not face the other. It is
  /// the density of x from y, too.
  static double density(const Vertex& x, const Vertex& y) {
    const glm::dvec3 way = y.position - x.position;
    const double square = glm::dot(way, way);
    const double here = glm::dot(way, x.normal), there = -glm::dot(way, y.normal);
    return here > 0 && there > 0 ? here * there / (pi * square * square) : 0;
  }

  bool isSeen(const Vertex& x, const Vertex& y) const {
    const auto hit = caster_.firstHit({x.position, glm::normalize(y.position - x.position), x.triangle});
    return hit && hit->front && hit->triangle == y.triangle;
  }

  /// A point of the lamps, of its density per area.
  Vertex lampPoint(const glm::dvec2& first, double second) const {
    const auto lamp = std::lower_bound(places_.begin(), std::prev(places_.end()), first.x,
                                       [](const Place& place, double value) { return place.upTo < value; });
    const double root = std::sqrt(first.y);
    const auto& [a, b, c] = lamp->corner;
    return {(1 - root) * a + root * (1 - second) * b + root * second * c, lamp->normal,
            static_cast<std::uint32_t>(lamp - places_.begin()), glm::dvec3(0)};
  }

  std::optional<reference::RayHit> firstFront(const Vertex& from, const glm::dvec2& way) const {
    const glm::dvec3 axis = std::abs(from.normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(axis, from.normal)), up = glm::cross(from.normal, right);
    const double radius = std::sqrt(way.x), angle = 2 * pi * way.y, cosine = std::sqrt(1 - way.x);
    const auto hit = caster_.firstHit(
        {from.position, radius * std::cos(angle) * right + radius * std::sin(angle) * up + cosine * from.normal,
         from.triangle});
    return hit && hit->front ? hit : std::nullopt;
  }

  /// How much each way counts that finds the ends x, y, z of paths, z on a lamp: by rays from x and from y; z chosen,
  /// and y by a ray from x; z chosen, and y by a ray from z. The arguments are densities; infinite if x is the eye.
  struct Ways {
    double rays, lamp, photon;
  };
  static Ways waysOf(double fromX, double fromY, double lamp) {
    const double photon = lamp * fromY / fromX, sum = fromY + lamp + photon;
    return {fromY / sum, lamp / sum, photon / sum};
  }

  /// The reflected radiosity at a front.
  glm::dvec3 reflected(const reference::RayHit& hit, glm::dvec2 lampPlace, glm::dvec2 way, Random& random) const {
    glm::dvec3 sum(0), share(1);
    if (!hasLamps_) return sum;
    double fromBefore = std::numeric_limits<double>::infinity();
    for (Vertex vertex = vertexOf(hit);;) {
      share *= vertex.reflectance;
      const Vertex lamp = lampPoint(lampPlace, random.next());
      if (const double seen = density(vertex, lamp); seen > 0 && isSeen(vertex, lamp)) {
        const double chosen = places_[lamp.triangle].density;
        sum += share * places_[lamp.triangle].emission * (seen / chosen * waysOf(fromBefore, seen, chosen).lamp);
      }
      const Vertex origin = lampPoint(random.pair(), random.next());
      if (const auto lit = firstFront(origin, random.pair())) {
        const Vertex between = vertexOf(*lit);
        if (const double seen = density(vertex, between); seen > 0 && isSeen(vertex, between)) {
          const double chosen = places_[origin.triangle].density;
          const double photon = waysOf(seen, density(between, origin), chosen).photon;
          sum += share * between.reflectance * places_[origin.triangle].emission * (seen / chosen * photon);
        }
      }
      const auto next = firstFront(vertex, way);
      if (!next) return sum;
      const Vertex met = vertexOf(*next);
      const double seen = density(vertex, met);
      if (const glm::dvec3& emission = places_[met.triangle].emission; radiosity::bandSum(emission) > 0 && seen > 0)
        sum += share * emission * waysOf(fromBefore, seen, places_[met.triangle].density).rays;
      const double survival = std::min(maxSurvival, std::max({share.r, share.g, share.b}));
      if (random.next() >= survival || seen == 0) return sum;
      share /= survival;
      fromBefore = seen;
      vertex = met;
      lampPlace = random.pair();
      way = random.pair();
    }
  }

  const radiosity::Scene& scene_;
  reference::RayCaster caster_;
  std::vector<Place> places_;
  bool hasLamps_ = false;
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
