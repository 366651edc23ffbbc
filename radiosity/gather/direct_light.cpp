#include "radiosity/gather/direct_light.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "radiosity/discretization/element_materials.h"
#include "radiosity/form_factors/surface_part.h"
#include "radiosity/geometry/convex_part.h"
#include "radiosity/projection/projection_kinds.h"

namespace hemitex::radiosity {
namespace {

constexpr std::size_t maxFaces = 64;
/// Triangles of one face have normals whose cosine is at least this.
constexpr double equalNormals = 1 - 1e-9;

/// Point k of the first 64 of a (0,2)-sequence: 2^n points from 0 on have one in each rectangle of area 2^-n that
/// halvings of the unit square lead to (Kollig and Keller 2002). In the middles of 64 x 64 cells.
glm::dvec2 netPoint(std::uint32_t k) {
  std::uint32_t x = 0, y = 0;
  for (std::uint32_t rest = k, v = 32, w = 32; rest != 0; rest >>= 1, v >>= 1, w ^= w >> 1) {
    if (rest & 1) x ^= v;
    if (rest & 1) y ^= w;
  }
  return (glm::dvec2(x, y) + 0.5) / 64.0;
}

using Corners = std::array<glm::dvec3, 3>;

/// Whether two triangles are those of a parallelogram, as the first and the second half of a fan.
bool isParallelogram(const std::vector<Corners>& triangles, double tolerance) {
  if (triangles.size() != 2) return false;
  const auto& [a, b, c] = triangles[0];
  const auto& [e, f, g] = triangles[1];
  return e == a && f == c && glm::distance(g, a + c - b) <= tolerance;
}

/// The point of a face for a point of the unit square, evenly by area.
glm::dvec3 pointOf(const std::vector<Corners>& triangles, bool isParallelogram, const glm::dvec2& at) {
  if (isParallelogram)
    return triangles[0][0] + at.x * (triangles[0][1] - triangles[0][0]) + at.y * (triangles[1][2] - triangles[0][0]);
  std::vector<SurfacePart::Face> faces;
  for (const Corners& corners : triangles) {
    const auto& [a, b, c] = corners;
    faces.push_back({corners, glm::dvec3(0), 0.5 * glm::length(glm::cross(b - a, c - a))});
  }
  return pointAt(faces, at).position;
}

/// Points near the corners of a face, each once, moved by `lift`.
std::vector<glm::dvec3> cornersOf(const std::vector<Corners>& triangles, const glm::dvec3& lift) {
  constexpr double inwards = 1 / 128.0;
  std::vector<glm::dvec3> known, corners;
  for (const Corners& triangle : triangles)
    for (const glm::dvec3& corner : triangle) {
      if (std::find(known.begin(), known.end(), corner) != known.end()) continue;
      known.push_back(corner);
      corners.push_back(glm::mix(corner, (triangle[0] + triangle[1] + triangle[2]) / 3.0, inwards) + lift);
    }
  return corners;
}

}  // namespace

DirectLight::DirectLight(const Scene& scene, const Discretization& discretization)
    : scene_(scene),
      discretization_(discretization),
      rays_(scene),
      height_(outlineTolerance(scene)),
      areSources_(scene.surfaces.size()) {
  addSuns();
  addLamps();
  addFaces();
}

void DirectLight::addSuns() {
  for (const Sun& sun : scene_.outside.suns)
    sources_.push_back({.light = lightInBands(scene_, sun.irradiance), .towards = sun.towards});
}

/// A lamp on a mirror plane is its own image, which is one source.
void DirectLight::addLamps() {
  for (const Lamp& lamp : scene_.lamps) {
    std::vector<std::pair<glm::dvec3, glm::dvec3>> known;
    for (const Instance& instance : scene_.instances) {
      const std::pair image(instance(lamp.position), lamp.cone ? instance.sign * lamp.cone->axis : glm::dvec3(0));
      if (std::find(known.begin(), known.end(), image) != known.end()) continue;
      known.push_back(image);
      Source source{.light = scaled(lightInBands(scene_, lamp.intensity), 1 / scene_.squareMetres),
                    .points = {image.first},
                    .cone = lamp.cone};
      if (source.cone) source.cone->axis = image.second;
      sources_.push_back(std::move(source));
    }
  }
}

std::vector<DirectLight::Source> DirectLight::facesOf(std::uint32_t surface) const {
  const Material& material = scene_.materials[static_cast<std::size_t>(scene_.surfaces[surface].material)];
  std::vector<Source> faces;
  for (const Instance& instance : scene_.instances) {
    const std::size_t first = faces.size();
    for (const Triangle& triangle : placed(scene_.surfaces[surface], instance).triangles) {
      const glm::dvec3 n = normal(triangle);
      const auto isIn = [&](const Source& face) {
        return glm::dot(face.normal, n) >= equalNormals &&
               std::abs(glm::dot(n, triangle.position[0] - face.triangles[0][0])) <= height_;
      };
      auto face = std::find_if(faces.begin() + static_cast<std::ptrdiff_t>(first), faces.end(), isIn);
      if (face == faces.end())
        face = faces.insert(face, {.light = emissionInBands(scene_, material), .triangles = {}, .normal = n});
      face->triangles.push_back(triangle.position);
    }
  }
  return faces;
}

void DirectLight::addFaces() {
  const ElementMaterials materials(scene_, discretization_);
  std::vector<std::pair<double, std::uint32_t>> byFlux;
  for (std::uint32_t s = 0; s < scene_.surfaces.size(); ++s) {
    const Material& material = scene_.materials[static_cast<std::size_t>(scene_.surfaces[s].material)];
    if (!material.emissionMap && !material.cutOut && !materials.isUnlit(s) && !discretization_.grids[s].isDark)
      byFlux.emplace_back(-area(scene_.surfaces[s]) * bandSum(emissionInBands(scene_, material)), s);
  }
  std::sort(byFlux.begin(), byFlux.end());
  std::size_t count = 0;
  for (const auto& [flux, surface] : byFlux) {
    std::vector<Source> faces = facesOf(surface);
    if (count + faces.size() > maxFaces) continue;
    count += faces.size();
    areSources_[surface] = true;
    for (Source& face : faces) {
      face.corners = cornersOf(face.triangles, height_ * face.normal);
      const bool isQuad = isParallelogram(face.triangles, height_);
      for (std::uint32_t k = 0; k < maxRays; ++k)
        face.points.push_back(pointOf(face.triangles, isQuad, netPoint(k)) + height_ * face.normal);
      sources_.push_back(std::move(face));
    }
  }
}

double DirectLight::factor(std::size_t number, const SurfacePoint& point) const {
  const Source& source = sources_[number];
  if (source.points.empty()) return std::max(glm::dot(point.normal, source.towards), 0.0);
  if (source.triangles.empty()) {
    const glm::dvec3 way = source.points.front() - point.position;
    const double squared = glm::dot(way, way), distance = std::sqrt(squared);
    if (!(distance > 0)) return 0;
    const double intensity = source.cone ? intensityAt(*source.cone, -glm::dot(source.cone->axis, way) / distance) : 1;
    return intensity * std::max(glm::dot(point.normal, way), 0.0) / (distance * squared);
  }
  if (glm::dot(source.normal, point.position - source.triangles[0][0]) <= 0) return 0;
  double sum = 0;
  for (const std::array<glm::dvec3, 3>& triangle : source.triangles)
    sum += fromPoint(point.position, point.normal, inFrontOf(triangle, point.position, point.normal));
  return std::min(sum, 1.0);
}

void DirectLight::addRay(const Source& source, const LitPlace& place, const glm::dvec2& at, const glm::dvec3& to,
                         Seen& sum) const {
  SurfacePoint point = place.point;
  point.position += at.x * place.along1 + at.y * place.along2;
  const glm::dvec3 start = eyeOver(scene_, place.surface, point);
  const bool isSun = source.points.empty();
  const glm::dvec3 way = isSun ? source.towards : to - start;
  double weight = 1;
  if (!source.triangles.empty()) {
    const double squared = glm::dot(way, way);
    const double cosines = std::max(glm::dot(point.normal, way), 0.0) * std::max(-glm::dot(source.normal, way), 0.0);
    weight = squared > 0 ? cosines / (squared * squared) : 0;
  }
  if (!(weight > 0)) return;
  sum.all += weight;
  if (!rays_.isBlocked(start, way, isSun ? std::numeric_limits<double>::infinity() : 1)) sum.seen += weight;
}

const glm::dvec3& DirectLight::pointOfRay(const Source& source, std::uint32_t k) {
  if (source.points.empty()) return source.towards;
  return source.points[k < source.points.size() ? k : 0];
}

double DirectLight::visibleShare(std::size_t number, const LitPlace& place, std::uint32_t rays) const {
  const Source& source = sources_[number];
  Seen sum;
  for (std::uint32_t k = 0; k < rays; ++k) addRay(source, place, spreadPoint(k) - 0.5, pointOfRay(source, k), sum);
  return sum.share();
}

double DirectLight::probedShare(std::size_t number, const LitPlace& place) const {
  constexpr double side = 0.49;
  const Source& source = sources_[number];
  Seen sum;
  std::uint32_t k = 0;
  for (const double x : {-side, side})
    for (const double y : {-side, side}) addRay(source, place, {x, y}, pointOfRay(source, k++), sum);
  for (const glm::dvec3& corner : source.corners) addRay(source, place, {0, 0}, corner, sum);
  return sum.share();
}

}  // namespace hemitex::radiosity
