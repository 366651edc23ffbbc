#include "radiosity/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "radiosity/spectra/colour.h"

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
}

/// Half of the last of the 24 bits of a binary32 number if that bit is set, else 0.
double roundingOf(double coordinate) {
  if (coordinate == 0) return 0;
  const double halfBit = std::ldexp(1.0, std::ilogb(coordinate) - 24);
  return std::fmod(coordinate / halfBit, 4) == 0 ? 0 : halfBit;
}

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

double area(const Triangle& triangle) { return 0.5 * glm::length(doubledArea(triangle)); }

double area(const Surface& surface) {
  double sum = 0;
  for (const Triangle& triangle : surface.triangles) sum += area(triangle);
  return sum;
}

void turnOver(Surface& surface) {
  for (Triangle& triangle : surface.triangles) exchangeSides(triangle);
}

glm::dvec3 normal(const Triangle& triangle) {
  const glm::dvec3 direction = doubledArea(triangle);
  return direction / glm::length(direction);
}

bool hasMaps(const Scene& scene, const Surface& surface) {
  const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
  return material.reflectanceMap || material.emissionMap;
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

void measureBounds(Scene& scene) {
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  bool areRounded = true;
  scene.rounding = 0;
  for (const Surface& surface : scene.surfaces) {
    for (const Triangle& triangle : surface.triangles) {
      for (const glm::dvec3& p : triangle.position) {
        low = glm::min(low, p);
        high = glm::max(high, p);
        areRounded = areRounded && glm::dvec3(glm::vec3(p)) == p;
        if (areRounded) scene.rounding = std::max({scene.rounding, roundingOf(p.x), roundingOf(p.y), roundingOf(p.z)});
      }
    }
  }
  const glm::dvec3 firstLow = low, firstHigh = high;
  for (const Instance& instance : scene.instances)
    for (const glm::dvec3& corner : {instance(firstLow), instance(firstHigh)}) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  scene.origin = 0.5 * (low + high);
  scene.extent = glm::length(high - low);
  if (!areRounded) scene.rounding = 0;
}

double contactTolerance(const Scene& scene) { return 8 * std::max(0x1p-24 * scene.extent, scene.rounding); }

}  // namespace hemitex::radiosity
