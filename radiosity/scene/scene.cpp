#include "radiosity/scene/scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "radiosity/spectra/colour.h"
#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::radiosity {
namespace {

Bands valuesAt(const std::vector<double>& wavelengths, const Spectrum& spectrum) {
  Bands values;
  for (const double wavelength : wavelengths) values.push_back(valueAt(spectrum, wavelength));
  return values;
}

glm::dvec3 doubledArea(const Triangle& t) {
  return glm::cross(t.position[1] - t.position[0], t.position[2] - t.position[0]);
}

void exchangeSides(Triangle& triangle) {
  std::swap(triangle.position[1], triangle.position[2]);
  std::swap(triangle.chart[1], triangle.chart[2]);
  std::swap(triangle.texcoord[1], triangle.texcoord[2]);
  std::swap(triangle.colour[1], triangle.colour[2]);
}

/// Half of the last of the 24 bits of a binary32 number if that bit is set, else 0.
double roundingOf(double coordinate) {
  if (coordinate == 0) return 0;
  const double halfBit = std::ldexp(1.0, std::ilogb(coordinate) - 24);
  return std::fmod(coordinate / halfBit, 4) == 0 ? 0 : halfBit;
}

/// By how much the largest coordinate is rounded, if all are binary32 numbers. A few may lack the last bit by chance,
/// so that all within a factor of 1024 tell: all are multiples of twice this bit if they are exact, such as whole
/// metres.
double largestCoordinateRounding(const Scene& scene) {
  double largest = 0;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec3& p : triangle.position) {
        if (glm::dvec3(glm::vec3(p)) != p) return 0;
        largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
      }
  if (largest == 0) return 0;
  const double bit = std::ldexp(1.0, std::ilogb(largest) - 23);
  const auto isFiner = [&](double c) { return std::abs(c) >= largest / 1024 && std::fmod(c, 2 * bit) != 0; };
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec3& p : triangle.position)
        if (isFiner(p.x) || isFiner(p.y) || isFiner(p.z)) return bit / 2;
  return 0;
}

double extentOf(const Bounds& bounds) { return glm::length(bounds.high - bounds.low); }

/// The bounds of the triangles that are accepted.
template <typename Accepts>
Bounds boundsOf(const Scene& scene, const Accepts& accepts) {
  Bounds bounds;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      if (accepts(triangle)) bounds.include(triangle);
  return bounds;
}

/// The bounds leave out triangles that make them this many times as large as those of the others, unless these
/// triangles have more than this share of all area.
constexpr double farAway = 256, largestShareLeftOut = 0.2;

/// The bounds of the triangles whose middles are not among the outermost tenth on either side along any axis.
Bounds boundsOfMost(const Scene& scene) {
  std::array<std::vector<double>, 3> along;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (int axis = 0; axis < 3; ++axis) along[static_cast<std::size_t>(axis)].push_back(middleOf(triangle)[axis]);
  glm::dvec3 low, high;
  const auto outermost = static_cast<std::ptrdiff_t>((along[0].size() + 5) / 10);
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double>& values = along[static_cast<std::size_t>(axis)];
    std::nth_element(values.begin(), values.begin() + outermost, values.end());
    low[axis] = values[static_cast<std::size_t>(outermost)];
    std::nth_element(values.begin(), values.end() - 1 - outermost, values.end());
    high[axis] = *(values.end() - 1 - outermost);
  }
  return boundsOf(scene, [&](const Triangle& triangle) {
    const glm::dvec3 middle = middleOf(triangle);
    return glm::all(glm::greaterThanEqual(middle, low)) && glm::all(glm::lessThanEqual(middle, high));
  });
}

/// The largest rounding of coordinates that counts, in sizes of a usual triangle: one that is rounded by more has no
/// shape to be in contact with.
constexpr double largestRounding = 0x1p-13;

}  // namespace

std::size_t bandCount(const Scene& scene) { return scene.wavelengths.empty() ? 3 : scene.wavelengths.size(); }

int channelOf(const Scene& scene, std::size_t band) {
  if (scene.wavelengths.empty()) return static_cast<int>(band);
  const double wavelength = scene.wavelengths[band];
  return wavelength >= 590 ? 0 : wavelength >= 490 ? 1 : 2;
}

Bands lightInBands(const Scene& scene, const glm::dvec3& colour) {
  if (scene.wavelengths.empty()) return {colour.r, colour.g, colour.b};
  const glm::dvec3 equalEnergy = linearSrgb({{555}, {1}});
  Bands light;
  for (std::size_t band = 0; band < bandCount(scene); ++band)
    light.push_back(colour[channelOf(scene, band)] / equalEnergy[channelOf(scene, band)]);
  return light;
}

Bands reflectanceInBands(const Scene& scene, const Material& material) {
  if (!scene.wavelengths.empty() && material.reflectanceSpectrum)
    return valuesAt(scene.wavelengths, *material.reflectanceSpectrum);
  Bands reflectance;
  for (std::size_t band = 0; band < bandCount(scene); ++band)
    reflectance.push_back(material.reflectance[channelOf(scene, band)]);
  return reflectance;
}

Bands emissionInBands(const Scene& scene, const Material& material) {
  if (!scene.wavelengths.empty() && material.emissionSpectrum)
    return valuesAt(scene.wavelengths, *material.emissionSpectrum);
  return lightInBands(scene, material.emission);
}

const CutOut* cutOutOf(const Scene& scene, const Surface& surface) {
  return scene.materials.empty() ? nullptr : scene.materials[static_cast<std::size_t>(surface.material)].cutOut.get();
}

bool hasCutOuts(const Scene& scene) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                     [&](const Surface& surface) { return cutOutOf(scene, surface) != nullptr; });
}

std::shared_ptr<const HoledTriangle> holedTriangle(const Scene& scene, const TrianglePlace& place) {
  const Surface& surface = scene.surfaces[place.surface];
  if (cutOutOf(scene, surface) == nullptr) return nullptr;
  return std::make_shared<HoledTriangle>(
      HoledTriangle{scene.materials[static_cast<std::size_t>(surface.material)].cutOut, placed(scene, place)});
}

bool isHole(const CutOut& cutOut, const Triangle& triangle, const glm::dvec2& weights) {
  const auto& [a, b, c] = triangle.texcoord;
  return isHoleAt(cutOut, a + weights.x * (b - a) + weights.y * (c - a));
}

double area(const Triangle& triangle) { return 0.5 * glm::length(doubledArea(triangle)); }

glm::dvec3 middleOf(const Triangle& triangle) {
  return (triangle.position[0] + triangle.position[1] + triangle.position[2]) / 3.0;
}

double area(const Surface& surface) {
  double sum = 0;
  for (const Triangle& triangle : surface.triangles) sum += area(triangle);
  return sum;
}

void turnOver(Surface& surface) {
  for (Triangle& triangle : surface.triangles) exchangeSides(triangle);
}

void makeTwins(std::vector<Surface>& surfaces, std::size_t one, std::size_t other) {
  surfaces[one].twin = static_cast<int>(other);
  surfaces[other].twin = static_cast<int>(one);
  for (const std::size_t s : {one, other})
    for (Triangle& triangle : surfaces[s].triangles) triangle.isBacked = true;
}

bool hasBacked(const Surface& surface) {
  return std::any_of(surface.triangles.begin(), surface.triangles.end(),
                     [](const Triangle& triangle) { return triangle.isBacked; });
}

bool hasBacks(const Scene& scene) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& surface) {
    return std::any_of(surface.triangles.begin(), surface.triangles.end(),
                       [](const Triangle& triangle) { return !triangle.isBacked; });
  });
}

bool emits(const Scene& scene, std::size_t surface) {
  return scene.materials[static_cast<std::size_t>(scene.surfaces[surface].material)].emission != glm::dvec3(0);
}

glm::dvec3 normal(const Triangle& triangle) {
  const glm::dvec3 direction = doubledArea(triangle);
  return direction / glm::length(direction);
}

bool hasMaps(const Scene& scene, const Surface& surface) {
  const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  return material.reflectanceMap || material.emissionMap || surface.hasColours;
}

bool hasMaps(const Scene& scene) {
  return std::any_of(scene.surfaces.begin(), scene.surfaces.end(),
                     [&](const Surface& surface) { return hasMaps(scene, surface); });
}

std::size_t triangleCount(const Scene& scene) {
  std::size_t count = 0;
  for (const Surface& surface : scene.surfaces) count += surface.triangles.size();
  return count;
}

Triangle placed(const Triangle& triangle, const Instance& instance) {
  Triangle moved = triangle;
  for (glm::dvec3& corner : moved.position) corner = instance(corner);
  if (instance.reflects()) exchangeSides(moved);
  return moved;
}

Surface placed(const Surface& surface, const Instance& instance) {
  Surface moved = surface;
  for (Triangle& triangle : moved.triangles) triangle = placed(triangle, instance);
  return moved;
}

glm::dvec2 placedWeights(const glm::dvec2& weights, const Instance& instance) {
  return instance.reflects() ? glm::dvec2(weights.y, weights.x) : weights;
}

std::size_t placedTriangleCount(const Scene& scene) { return scene.instances.size() * triangleCount(scene); }

Bounds boundsOf(const Scene& scene) {
  const Bounds all = boundsOf(scene, [](const Triangle&) { return true; }), middle = boundsOfMost(scene);
  if (!(extentOf(all) > farAway * extentOf(middle))) return all;
  const glm::dvec3 centre = 0.5 * (middle.low + middle.high);
  double sum = 0, kept = 0;
  const Bounds near = boundsOf(scene, [&](const Triangle& triangle) {
    const bool isNear = glm::distance(middleOf(triangle), centre) <= 0.5 * farAway * extentOf(middle);
    sum += area(triangle);
    if (isNear) kept += area(triangle);
    return isNear;
  });
  return extentOf(all) > farAway * extentOf(near) && kept >= (1 - largestShareLeftOut) * sum ? near : all;
}

double coordinateRounding(const Scene& scene) {
  double rounding = 0;
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles)
      for (const glm::dvec3& p : triangle.position) {
        if (glm::dvec3(glm::vec3(p)) != p) return 0;
        rounding = std::max({rounding, roundingOf(p.x), roundingOf(p.y), roundingOf(p.z)});
      }
  return rounding;
}

double meanSize(const Scene& scene) {
  double sum = 0;
  for (const Surface& surface : scene.surfaces) sum += area(surface);
  return std::sqrt(sum / static_cast<double>(triangleCount(scene)));
}

void measureBounds(Scene& scene) {
  Bounds bounds = boundsOf(scene);
  const Bounds first = bounds;
  for (const Instance& instance : scene.instances) {
    bounds.include(instance(first.low));
    bounds.include(instance(first.high));
  }
  scene.origin = 0.5 * (bounds.low + bounds.high);
  scene.extent = extentOf(bounds);
  scene.rounding = coordinateRounding(scene);
  if (scene.rounding > 0) scene.rounding = std::min(scene.rounding, largestRounding * meanSize(scene));
}

std::vector<std::string> resolutionWarnings(const Scene& scene) {
  std::vector<std::string> warnings;
  for (const Surface& surface : scene.surfaces)
    if (std::any_of(surface.triangles.begin(), surface.triangles.end(), [&](const Triangle& triangle) {
          return std::any_of(triangle.position.begin(), triangle.position.end(), [&](const glm::dvec3& corner) {
            return glm::distance(corner, scene.origin) > scene.extent;
          });
        }))
      warnings.push_back("`" + raster::excerpt(surface.name) +
                         "` lies more than a hundred times the size of the other surfaces away from them; positions "
                         "there are too coarse for its own light");
  if (warnings.size() > 3) {
    warnings[2] = std::to_string(warnings.size() - 2) + " more surfaces are as far away";
    warnings.resize(3);
  }
  return warnings;
}

std::vector<std::string> roundingWarnings(const Scene& scene) {
  const double rounding = largestCoordinateRounding(scene), size = meanSize(scene);
  if (!(rounding > 0.01 * size)) return {};
  return {"its coordinates are rounded to binary32 by up to " + raster::shortNumber(rounding) +
          " units, and its faces are about " + raster::shortNumber(size) +
          " units across, so that their shapes and their light are wrong; move the scene to the origin before it is "
          "written, or write numbers of double precision"};
}

double contactTolerance(const Scene& scene) { return 8 * std::max(0x1p-24 * scene.extent, scene.rounding); }

}  // namespace hemitex::radiosity
