#include "radiosity/form_factors/surface_part.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/geometry/convex_part.h"

namespace hemitex::radiosity {
namespace {

using Corners = std::array<glm::dvec3, 3>;

/// A triangle is divided while that changes its form factor by more than this share of all.
constexpr double mostChange = 0.0005;
/// Four times as much if small results do not matter.
constexpr double roughly = 4;
/// Number of times that triangles are divided at most.
constexpr int maxDivisions = 6;

/// A point of the part whose mean form factor is wanted.
struct Sample {
  glm::dvec3 point, normal;
  double area = 0;
  double factor = 0;  ///< the form factor to the other part
};

void add(SurfacePart& part, const Corners& corners, const glm::dvec3& normal) {
  const glm::dvec3 product = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
  const double area = 0.5 * glm::length(product);
  if (!(area > 0)) return;
  part.faces.push_back({corners, normal, area});
  if (glm::dot(product, normal) < 0) std::swap(part.faces.back().corners[1], part.faces.back().corners[2]);
  for (const glm::dvec3& corner : corners) part.bounds.include(corner);
  part.area += area;
}

double factorFrom(const glm::dvec3& point, const glm::dvec3& normal, const SurfacePart& to) {
  double sum = 0;
  for (const SurfacePart::Face& face : to.faces)
    if (glm::dot(face.normal, point - face.corners[0]) > 0)
      sum += fromPoint(point, normal, inFrontOf(face.corners, point, normal));
  return std::min(sum, 1.0);
}

Sample sampleAt(const glm::dvec3& point, double area, const glm::dvec3& normal, const SurfacePart& to) {
  return {point, normal, area, factorFrom(point, normal, to)};
}

double exchangeOf(std::span<const Sample> samples) {
  double sum = 0;
  for (const Sample& sample : samples) sum += sample.area * sample.factor;
  return sum;
}

Sample middleOf(const SurfacePart::Face& face, const SurfacePart& to) {
  return sampleAt((face.corners[0] + face.corners[1] + face.corners[2]) / 3.0, face.area, face.normal, to);
}

/// Appends samples of a triangle: three points whose mean is exact for polynomials of degree two, if the middle gives
/// the same.
void appendSamples(const SurfacePart::Face& face, const SurfacePart& to, const Sample& middle, double tolerance,
                   int divisions, std::vector<Sample>& samples) {
  const auto& [a, b, c] = face.corners;
  std::array<Sample, 3> three;
  for (std::size_t k = 0; k < 3; ++k)
    three[k] = sampleAt((a + b + c) / 6.0 + 0.5 * face.corners[k], face.area / 3, face.normal, to);
  if (divisions == maxDivisions || std::abs(exchangeOf(three) - middle.area * middle.factor) <= tolerance) {
    samples.insert(samples.end(), three.begin(), three.end());
    return;
  }
  const glm::dvec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
  for (const Corners& corners : {Corners{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {bc, ca, ab}}) {
    const SurfacePart::Face quarter{corners, face.normal, face.area / 4};
    appendSamples(quarter, to, middleOf(quarter, to), tolerance, divisions + 1, samples);
  }
}

/// The largest result that makes no samples.
double tooLittle(const NearAccuracy& accuracy) { return 0.5 * accuracy.least; }

/// Whether even facing each other, the parts have less than that: a form factor from a point is at most the area of the
/// other part over pi d^2 at its smallest distance d. The factor is for rounding.
bool areFarApart(const SurfacePart& a, const SurfacePart& b, const NearAccuracy& accuracy) {
  const double distance = distanceBetween(a.bounds, b.bounds);
  return 1.001 * a.area * b.area < tooLittle(accuracy) * std::numbers::pi * distance * distance;
}

/// Samples of a part that see the other without blockers; none if the middles of its faces give too little.
std::vector<Sample> samplesOf(const SurfacePart& part, const SurfacePart& to, const NearAccuracy& accuracy) {
  std::vector<Sample> middles, samples;
  for (const SurfacePart::Face& face : part.faces) middles.push_back(middleOf(face, to));
  const double coarse = exchangeOf(middles);
  if (coarse < tooLittle(accuracy)) return samples;
  const double tolerance = (accuracy.least > 0 ? roughly : 1) * mostChange * coarse;
  for (std::size_t f = 0; f < part.faces.size(); ++f)
    appendSamples(part.faces[f], to, middles[f], tolerance, 0, samples);
  std::erase_if(samples, [](const Sample& sample) { return !(sample.factor > 0); });
  return samples;
}

Sample pointOn(const SurfacePart& part, std::size_t k) {
  const PlacedPoint point = pointAt(part.faces, spreadPoint(k));
  return {point.position, part.faces[point.face].normal, part.area};
}

/// What rays have found.
struct Rays {
  double seen = 0, all = 0;
};

void addRay(const Sample& from, const Sample& to, const RayTree& tree, double height, Rays& rays) {
  const glm::dvec3 way = to.point - from.point;
  const double squared = glm::dot(way, way);
  const double cosines = std::max(glm::dot(from.normal, way), 0.0) * std::max(-glm::dot(to.normal, way), 0.0);
  if (!(cosines > 0)) return;
  const double weight = from.area * std::min(cosines * to.area / (squared * squared * std::numbers::pi), 1.0);
  rays.all += weight;
  const glm::dvec3 start = from.point + height * from.normal, end = to.point + height * to.normal;
  if (!tree.isBlocked(start, end - start, 1)) rays.seen += weight;
}

/// A quarter of the rays is enough if all of them are blocked, or none.
double visibleShare(const std::vector<Sample>& samples, const SurfacePart& to, const RayTree& tree, double height,
                    std::size_t count) {
  Rays rays;
  for (std::size_t first = 0; first < 4; ++first) {
    for (std::size_t k = first; k < count; k += 4)
      addRay(samples[(2 * k + 1) * std::max(samples.size(), count) / (2 * count) % samples.size()], pointOn(to, k),
             tree, height, rays);
    if (first == 0 && rays.all > 0 && (rays.seen == 0 || rays.seen == rays.all)) break;
  }
  return rays.all > 0 ? rays.seen / rays.all : 0;
}

/// A leaf of a quadtree, or a texel.
Patch rectangleOf(const Discretization& discretization, std::uint32_t number) {
  const Element& element = discretization.elements[number];
  const Leaf leaf = leafOf(discretization.grids[element.surface], element.texel);
  return {.surface = element.surface, .column = leaf.column, .row = leaf.row, .width = leaf.side, .height = leaf.side};
}

}  // namespace

SurfacePart partOf(const Scene& scene, const Discretization& discretization, const Patch& patch) {
  const Surface& surface = scene.surfaces[patch.surface];
  const glm::dvec2 low(patch.column, patch.row);
  SurfacePart part;
  forEachExposedPiece(surface, texelGrid(discretization.grids[patch.surface]), low,
                      low + glm::dvec2(patch.width, patch.height),
                      [&](std::size_t, std::uint32_t number, const Piece& piece) {
                        const Triangle& triangle = surface.triangles[number];
                        const auto at = [&](std::size_t k) {
                          const auto& [a, b, c] = triangle.position;
                          const glm::dvec2& weight = piece.corners[k].weight;
                          return a + weight.x * (b - a) + weight.y * (c - a);
                        };
                        for (std::size_t k = 2; k < piece.size; ++k)
                          add(part, {at(0), at(k - 1), at(k)}, normal(triangle));
                      });
  return part;
}

SurfacePart partOf(const Scene& scene, const Discretization& discretization, std::uint32_t element) {
  return partOf(scene, discretization, rectangleOf(discretization, element));
}

SurfacePart placed(const SurfacePart& part, const Instance& instance) {
  SurfacePart result;
  for (const SurfacePart::Face& face : part.faces)
    add(result, {instance(face.corners[0]), instance(face.corners[1]), instance(face.corners[2])},
        instance.sign * face.normal);
  return result;
}

glm::dvec2 spreadPoint(std::size_t k) {
  const glm::dvec2 point = 0.5 + double(k) * glm::dvec2(0.7548776662466927, 0.5698402909980532);
  return point - glm::floor(point);
}

PlacedPoint pointAt(std::span<const SurfacePart::Face> faces, const glm::dvec2& at) {
  double rest = 0;
  for (const SurfacePart::Face& face : faces) rest += face.area;
  rest *= at.x;
  std::size_t f = 0;
  for (; f + 1 < faces.size() && rest >= faces[f].area; ++f) rest -= faces[f].area;
  const double root = std::sqrt(std::min(rest / faces[f].area, 1.0));
  const auto& [a, b, c] = faces[f].corners;
  return {a + root * ((1 - at.y) * (b - a) + at.y * (c - a)), f};
}

double distanceBetween(const Bounds& a, const Bounds& b) {
  return glm::length(glm::max(glm::max(a.low - b.high, b.low - a.high), 0.0));
}

double exchangeArea(const SurfacePart& a, const SurfacePart& b, const RayTree& tree, const NearAccuracy& accuracy) {
  if (areFarApart(a, b, accuracy)) return 0;
  const bool isFirst = a.size() <= b.size();
  const SurfacePart &from = isFirst ? a : b, &to = isFirst ? b : a;
  const std::vector<Sample> samples = samplesOf(from, to, accuracy);
  if (samples.empty()) return 0;
  return exchangeOf(samples) * visibleShare(samples, to, tree, accuracy.height, accuracy.rays);
}

}  // namespace hemitex::radiosity
