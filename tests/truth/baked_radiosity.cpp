#include "tests/truth/baked_radiosity.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>

#include "radiosity/projection/parallel_view.h"
#include "radiosity/projection/projection_kinds.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/surface_pieces.h"
#include "reference/truth/rays/ray_caster.h"
#include "reference/truth/rays/ray_source.h"
#include "reference/truth/rays/sample_points.h"

namespace hemitex::tests {
namespace {

using namespace reference;
using std::numbers::pi;
/// Maximum probability that a path survives a bounce, for any reflectance.
constexpr double maxSurvival = 0.99;
constexpr int maxBounces = 1024;
constexpr int buriedWalks = 32, walkBounces = 64;
/// In extents: a face this near to a point lies on it. Far above rounding, far below any intended gap.
constexpr double onPoint = 0x1p-30;

class Random {
 public:
  explicit Random(std::uint32_t seed) : random_(seed) {}
  /// In (0, 1).
  double next() { return (static_cast<double>(random_()) + 0.5) * 0x1p-32; }

 private:
  std::mt19937 random_;
};

using radiosity::bandSum;

/// Cosine-distributed about a normal: a point of the unit disk, projected up to the hemisphere (Malley 1988).
glm::dvec3 cosineDirection(const glm::dvec3& normal, double x, double y) {
  const glm::dvec3 axis = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, normal)), up = glm::cross(normal, right);
  const double radius = std::sqrt(x), angle = 2 * pi * y;
  return glm::normalize(radius * std::cos(angle) * right + radius * std::sin(angle) * up + std::sqrt(1 - x) * normal);
}

glm::dvec3 cosineDirection(const glm::dvec3& normal, Random& random) {
  const double x = random.next(), y = random.next();
  return cosineDirection(normal, x, y);
}

/// A triangle of the scene, by number.
struct Place {
  std::uint32_t surface, triangle;
  std::array<glm::dvec3, 3> corner;  ///< in the frame of the scene
  glm::dvec3 normal;
};

std::vector<Place> placesOf(const radiosity::Scene& scene) {
  std::vector<Place> places;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    for (std::uint32_t t = 0; t < scene.surfaces[s].triangles.size(); ++t) {
      const radiosity::Triangle& triangle = scene.surfaces[s].triangles[t];
      places.push_back({s, t, inFrame(scene, triangle), radiosity::normal(triangle)});
    }
  return places;
}

/// An element that emits, a lamp that is a point, or the sky.
struct Light {
  std::optional<RaySource> raySource;  ///< of an element
  const radiosity::Lamp* lamp;         ///< null for others
  glm::dvec3 power;  ///< flux of a path that starts here, W; all paths together carry the emitted flux
  double upTo;       ///< cumulative share of the flux of the lights; the last is 1
};

/// Number of no triangle, for rays that start in the sky or at lamps.
constexpr std::uint32_t noTriangle = ~0u;

/// A sphere around the scene, in its frame.
struct SkySphere {
  glm::dvec3 centre{0.0};
  double radius = 0;
};

SkySphere skyOf(const radiosity::Scene& scene) {
  const radiosity::BoundingSphere bounds = radiosity::boundingSphere(scene);
  return {(bounds.centre - scene.origin) / scene.extent, bounds.radius / scene.extent * 1.001};
}

using ElementFlux = std::vector<glm::dvec3>;

class Tracer {
 public:
  Tracer(const radiosity::Scene& scene, const radiosity::Discretization& discretization)
      : scene_(scene),
        discretization_(discretization),
        pieces_(surfacePieces(scene, discretization)),
        places_(placesOf(scene)),
        caster_(scene),
        sky_(skyOf(scene)) {
    findLights();
  }

  /// The flux that arrives at each element with the paths of one block, W.
  ElementFlux arriving(const SamplePoints& points, std::size_t block, std::uint32_t seed) const {
    ElementFlux sum(discretization_.elements.size(), glm::dvec3(0));
    if (lights_.empty()) return sum;
    Random random(seed);
    for (std::size_t i = 0; i < points.count(); ++i) trace(points.at(block, i), random, sum);
    for (glm::dvec3& flux : sum) flux /= static_cast<double>(points.count());
    return sum;
  }

  /// The share of an element that is not buried.
  Measurement exposedShare(std::uint32_t element, std::size_t count, std::uint32_t seed) const {
    const SamplePoints points(count, 2 * seed);
    Random random(2 * seed + 1);
    const RaySource raySource = areaRaySource(pieces_, std::array{element});
    const bool emits = bandSum(radiosity::emission(scene_, discretization_, element)) > 0;
    std::array<double, sampleBlocks> shares{};
    for (std::size_t block = 0; block < sampleBlocks; ++block)
      for (std::size_t i = 0; i < count; ++i) {
        const SamplePoint sample = points.at(block, i);
        if (!isBuried(shootingPoint(raySource, sample[0], sample[1]), emits, random))
          shares[block] += 1 / static_cast<double>(count);
      }
    return meanOf(shares);
  }

 private:
  void findLights() {
    double sum = 0;
    for (std::uint32_t e = 0; e < discretization_.elements.size(); ++e) {
      const glm::dvec3 emission = radiosity::emission(scene_, discretization_, e);
      if (bandSum(emission) == 0) continue;
      sum += discretization_.elements[e].area * bandSum(emission);
      lights_.push_back({areaRaySource(pieces_, std::array{e}), nullptr, emission / bandSum(emission), sum});
    }
    for (const radiosity::Lamp& lamp : scene_.lamps) {
      sum += radiosity::fullSolidAngle(lamp.cone) * bandSum(lamp.intensity);
      lights_.push_back({std::nullopt, &lamp, lamp.intensity / bandSum(lamp.intensity), sum});
    }
    if (const glm::dvec3& sky = scene_.outside.sky; bandSum(sky) > 0) {
      // A sphere around the scene that emits inwards: its radiosity is the irradiance of an open plane.
      const double radius = sky_.radius * scene_.extent;
      sum += 4 * pi * radius * radius * bandSum(sky);
      lights_.push_back({std::nullopt, nullptr, sky / bandSum(sky), sum});
    }
    for (Light& light : lights_) {
      light.upTo /= sum;
      light.power *= sum;
    }
  }

  std::uint32_t elementOf(const RayHit& hit) const {
    const Place& place = places_[hit.triangle];
    return elementAt(scene_.surfaces[place.surface].triangles[place.triangle], discretization_.grids[place.surface],
                     hit.weights);
  }

  ShootingPoint pointAt(const RayHit& hit) const {
    const Place& place = places_[hit.triangle];
    const auto& [a, b, c] = place.corner;
    return {a + hit.weights.x * (b - a) + hit.weights.y * (c - a), place.normal, hit.triangle};
  }

  std::optional<RayHit> cast(const ShootingPoint& from, const glm::dvec3& direction) const {
    return caster_.firstHit({from.position, direction, from.triangle});
  }

  /// The light whose interval of the cumulative flux contains x, in [0, 1).
  std::vector<Light>::const_iterator lightAt(double x) const {
    return std::upper_bound(lights_.begin(), std::prev(lights_.end()), x,
                            [](double value, const Light& light) { return value < light.upTo; });
  }

  void trace(const SamplePoint& sample, Random& random, ElementFlux& arrived) const {
    const Light& light = *lightAt(sample[0]);
    const glm::dvec3 power = light.power;
    ShootingPoint at = lightPoint(sample[0], sample[1]);
    glm::dvec3 direction = cosineDirection(at.normal, sample[2], sample[3]), share(1);
    if (light.lamp) direction = lampDirection(*light.lamp, sample[2], sample[3], share);
    for (int bounce = 0; bounce < maxBounces; ++bounce) {
      const auto hit = cast(at, direction);
      if (!hit || !hit->front) return;
      const std::uint32_t element = elementOf(*hit);
      arrived[element] += power * share;
      share *= radiosity::reflectance(scene_, discretization_, element);
      const double survival = std::min(maxSurvival, std::max({share.r, share.g, share.b}));
      if (random.next() >= survival) return;
      share /= survival;
      at = pointAt(*hit);
      direction = cosineDirection(at.normal, random);
    }
  }

  /// Whether a face lies on the point and faces it: from just above the point, the back of that face is visible.
  bool isCovered(const ShootingPoint& point) const {
    const glm::dvec3 above = point.position + onPoint * point.normal;
    const auto hit = caster_.firstHit({above, -point.normal, point.triangle});
    return hit && !hit->front && glm::distance(pointAt(*hit).position, above) < 2 * onPoint;
  }

  ShootingPoint lightPoint(double x, double y) const {
    const auto light = lightAt(x);
    const double before = light == lights_.begin() ? 0 : std::prev(light)->upTo;
    const double place = (x - before) / (light->upTo - before);
    if (light->lamp) return {(light->lamp->position - scene_.origin) / scene_.extent, glm::dvec3(0, 0, 1), noTriangle};
    return light->raySource ? shootingPoint(*light->raySource, place, y) : skyPoint(place, y);
  }

  /// Uniform over all directions, or over those of a cone. Multiplies `share` by the flux in this direction over that
  /// of a uniform lamp.
  static glm::dvec3 lampDirection(const radiosity::Lamp& lamp, double x, double y, glm::dvec3& share) {
    const glm::dvec3 axis = lamp.cone ? lamp.cone->axis : glm::dvec3(0, 0, 1);
    const double least = lamp.cone ? lamp.cone->outerCosine : -1;
    const double cosine = least + x * (1 - least), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    if (lamp.cone) {
      const double ramp = std::min((cosine - least) / (lamp.cone->innerCosine - least), 1.0);
      share *= ramp * ramp * 2 * pi * (1 - least) / radiosity::fullSolidAngle(lamp.cone);
    }
    const glm::dvec3 across = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 right = glm::normalize(glm::cross(across, axis)), up = glm::cross(axis, right);
    return glm::normalize(cosine * axis + sine * (std::cos(2 * pi * y) * right + std::sin(2 * pi * y) * up));
  }

  /// Equal areas of a cylinder around the sphere map to equal areas of the sphere (Archimedes).
  ShootingPoint skyPoint(double x, double y) const {
    const double z = 1 - 2 * x, radius = std::sqrt(std::max(0.0, 1 - z * z)), angle = 2 * pi * y;
    const glm::dvec3 out(radius * std::cos(angle), radius * std::sin(angle), z);
    return {sky_.centre + sky_.radius * out, -out, noTriangle};
  }

  /// Whether light arrives from a random point of the lights.
  bool seesLight(const ShootingPoint& at, Random& random) const {
    if (lights_.empty()) return false;
    const double x = random.next(), y = random.next();
    const ShootingPoint light = lightPoint(x, y);
    const glm::dvec3 way = light.position - at.position;
    if (lightAt(x)->lamp) {
      const auto hit = cast(at, glm::normalize(way));
      return glm::dot(way, at.normal) > 0 &&
             (!hit || glm::distance(pointAt(*hit).position, at.position) > glm::length(way));
    }
    if (light.triangle == at.triangle || !(glm::dot(way, at.normal) > 0) || !(glm::dot(way, light.normal) < 0))
      return false;
    const auto hit = cast(at, glm::normalize(way));
    return hit && hit->front && hit->triangle == light.triangle;
  }

  enum class Walk { Light, Back, Background, Nothing };

  /// A random walk from a point that all fronts reflect; returns the first other hit.
  Walk walk(ShootingPoint at, Random& random) const {
    for (int bounce = 0; bounce < walkBounces; ++bounce) {
      if (seesLight(at, random)) return Walk::Light;
      const auto hit = cast(at, cosineDirection(at.normal, random));
      if (!hit) return bandSum(scene_.outside.sky) > 0 ? Walk::Light : Walk::Background;
      if (!hit->front) return Walk::Back;
      at = pointAt(*hit);
    }
    return Walk::Nothing;
  }

  bool isBuried(const ShootingPoint& point, bool emits, Random& random) const {
    if (isCovered(point)) return true;
    bool isOutside = false;
    for (int i = 0; i < buriedWalks; ++i) {
      const Walk met = walk(point, random);
      if (met == Walk::Light) return false;
      isOutside = isOutside || met == Walk::Back || (met == Walk::Background && !emits);
    }
    return isOutside;
  }

  const radiosity::Scene& scene_;
  const radiosity::Discretization& discretization_;
  SurfacePieces pieces_;
  std::vector<Place> places_;
  RayCaster caster_;
  SkySphere sky_;
  std::vector<Light> lights_;
};

using Estimates = std::array<glm::dvec3, sampleBlocks>;

struct BandMeasurement {
  glm::dvec3 value{0.0}, standardError{0.0};
};

BandMeasurement meanOf(const Estimates& estimates) {
  BandMeasurement result;
  for (int band = 0; band < 3; ++band) {
    std::array<double, sampleBlocks> values{};
    for (std::size_t block = 0; block < sampleBlocks; ++block) values[block] = estimates[block][band];
    const Measurement mean = reference::meanOf(values);
    result.value[band] = mean.value;
    result.standardError[band] = mean.standardError;
  }
  return result;
}

/// The combined error of independent errors.
glm::dvec3 together(const glm::dvec3& a, const glm::dvec3& b) { return glm::sqrt(a * a + b * b); }

/// Errors of elements are not independent, because paths connect them. So each block is summed separately.
SurfaceFlux sumOf(const std::vector<std::uint32_t>& elements, const std::array<ElementFlux, sampleBlocks>& reflected,
                  const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                  const BakedRadiosity& baked) {
  SurfaceFlux sum;
  Estimates estimates;
  estimates.fill(glm::dvec3(0));
  glm::dvec3 squares(0);
  double areaSquares = 0;
  for (const std::uint32_t e : elements) {
    sum.exposedArea += baked.exposedArea[e];
    sum.flux += baked.flux[e];
    const glm::dvec3 emittedError = radiosity::emission(scene, discretization, e) * baked.exposedAreaError[e];
    squares += emittedError * emittedError;
    areaSquares += baked.exposedAreaError[e] * baked.exposedAreaError[e];
    for (std::size_t block = 0; block < sampleBlocks; ++block) estimates[block] += reflected[block][e];
  }
  sum.exposedAreaError = std::sqrt(areaSquares);
  sum.fluxError = together(meanOf(estimates).standardError, glm::sqrt(squares));
  return sum;
}

/// The number of points per block.
std::size_t perBlock(int count, const std::string& what) {
  constexpr int blocks = sampleBlocks;
  if (count < blocks || count % blocks != 0 || !std::has_single_bit(static_cast<unsigned>(count / blocks)) ||
      count >= 1 << 30)
    throw raster::InputError("the number of " + what + " is " + std::to_string(count),
                             "use " + std::to_string(blocks) + " times a power of two, below 2^30");
  return static_cast<std::size_t>(count / blocks);
}

}  // namespace

BakedRadiosity bakedRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const BakeSettings& settings) {
  const std::size_t paths = perBlock(settings.paths, "paths"), points = perBlock(settings.points, "points");
  const Tracer tracer(scene, discretization);
  const std::size_t count = discretization.elements.size();
  const auto seedOf = [&](std::size_t i) { return settings.seed * 0x10000001U + static_cast<std::uint32_t>(i); };

  const SamplePoints starts(paths, settings.seed);
  std::array<ElementFlux, sampleBlocks> reflected;
  raster::parallelFor(sampleBlocks, [&](std::size_t block) {
    reflected[block] = tracer.arriving(starts, block, ~seedOf(block));
    for (std::uint32_t e = 0; e < count; ++e) reflected[block][e] *= radiosity::reflectance(scene, discretization, e);
  });

  const ElementFlux dark(count, glm::dvec3(0));
  BakedRadiosity baked{std::vector<double>(count), std::vector<double>(count), dark, dark, dark, dark, {}};
  raster::parallelFor(count, [&](std::size_t e) {
    const auto element = static_cast<std::uint32_t>(e);
    const double area = discretization.elements[e].area;
    const Measurement share = tracer.exposedShare(element, points, seedOf(e));
    const glm::dvec3 emission = radiosity::emission(scene, discretization, element);
    const double exposed = area * share.value, exposedError = area * share.standardError;
    Estimates estimates;
    for (std::size_t block = 0; block < sampleBlocks; ++block) estimates[block] = reflected[block][e];
    const auto [value, error] = meanOf(estimates);
    baked.exposedArea[e] = exposed;
    baked.exposedAreaError[e] = exposedError;
    baked.flux[e] = value + emission * exposed;
    baked.fluxError[e] = together(error, emission * exposedError);
    if (exposed == 0) return;
    baked.radiosity[e] = value / exposed + emission;
    baked.radiosityError[e] = together(error, value / exposed * exposedError) / exposed;
  });
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s)
    baked.surfaces.push_back(sumOf(elementsOfSurface(discretization, s), reflected, scene, discretization, baked));
  return baked;
}

}  // namespace hemitex::tests
