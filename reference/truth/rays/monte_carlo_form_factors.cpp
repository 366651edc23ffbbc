#include "reference/truth/rays/monte_carlo_form_factors.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <functional>
#include <numbers>
#include <numeric>

#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/point_to_polygon.h"
#include "reference/truth/rays/solid_angle.h"

namespace hemitex::reference {
namespace {

using std::numbers::pi;
/// Error of the closed forms, as a share of all light; far below that of rays.
constexpr double closedFormError = 1e-10;
/// A receiver that no ray met may still have the light of this number of rays.
constexpr double fewestRays = 2;

/// The sums of one block: receivers, then backs, then background.
using Sums = std::vector<double>;

/// Adds the contribution of one point of the sequence.
using AddSample = std::function<void(const SamplePoint&, Sums&)>;

/// Sums each block separately, in order, and averages the results.
MeasuredRow measure(std::uint32_t receivers, const Sampling& sampling, const AddSample& add) {
  assert(sampling.samples > 0);
  const std::size_t count = (static_cast<std::size_t>(sampling.samples) + sampleBlocks - 1) / sampleBlocks;
  const SamplePoints points(count, sampling.seed);
  std::vector<Sums> sums(sampleBlocks, Sums(receivers + 2, 0.0));
  raster::parallelFor(sampleBlocks, [&](std::size_t block) {
    for (std::size_t i = 0; i < count; ++i) add(points.at(block, i), sums[block]);
  });
  const auto mean = [&](std::size_t column) {
    std::array<double, sampleBlocks> values;
    for (std::size_t block = 0; block < sampleBlocks; ++block)
      values[block] = sums[block][column] / static_cast<double>(count);
    return meanOf(values);
  };
  MeasuredRow row;
  for (std::uint32_t receiver = 0; receiver < receivers; ++receiver) row.receivers.push_back(mean(receiver));
  row.back = mean(receivers);
  row.background = mean(receivers + 1);
  return row;
}

/// A direction over the hemisphere around a normal, uniform in projected solid angle: a point of the unit disk,
/// projected up to the hemisphere (Malley 1988).
glm::dvec3 cosineDirection(const glm::dvec3& normal, double x, double y) {
  const glm::dvec3 axis = std::abs(normal.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(axis, normal)), up = glm::cross(normal, right);
  const double radius = std::sqrt(x), angle = 2 * pi * y;
  return radius * (std::cos(angle) * right + std::sin(angle) * up) + std::sqrt(1 - x) * normal;
}

/// The side of a piece that a point sees, as a polygon that is counter-clockwise from there.
struct SeenSide {
  bool front;
  std::vector<glm::dvec3> polygon;
};

/// Nothing if the piece's plane passes within epsilon of the point, or if no corner is that far above the point's
/// tangent plane; rays would not meet it either.
std::optional<SeenSide> seenSide(const SurfacePiece& piece, const ShootingPoint& point) {
  const double height = glm::dot(piece.normal, point.position - piece.corner[0]);
  const bool rises = std::any_of(piece.corner.begin(), piece.corner.end(), [&](const glm::dvec3& corner) {
    return glm::dot(corner - point.position, point.normal) > rayEpsilon;
  });
  if (std::abs(height) <= rayEpsilon || !rises) return std::nullopt;
  if (height > 0) return SeenSide{true, piece.corner};
  return SeenSide{false, {piece.corner.rbegin(), piece.corner.rend()}};
}

/// The share of the light from a point to a polygon that blockers hide. The polygon is part of a triangle of the scene.
/// A direction into it represents its solid angle, and counts if the ray meets something else first.
double hiddenFactor(const RayCaster& rays, const ShootingPoint& point, std::span<const glm::dvec3> polygon,
                    std::uint32_t triangle, double x, double y) {
  const Aim aim = aimInto(polygon, point.position, x, y);
  const double cosine = glm::dot(aim.direction, point.normal);
  if (cosine <= 0) return 0;
  const std::optional<RayHit> hit = rays.firstHit({point.position, aim.direction, point.triangle});
  return hit && hit->triangle == triangle ? 0 : cosine / pi * aim.solidAngle;
}

}  // namespace

Receivers everyElement(const radiosity::Discretization& discretization) {
  Receivers receivers{static_cast<std::uint32_t>(discretization.elements.size()),
                      std::vector<std::uint32_t>(discretization.elements.size())};
  std::iota(receivers.ofElement.begin(), receivers.ofElement.end(), 0U);
  return receivers;
}

RayFormFactors::RayFormFactors(const radiosity::Scene& scene, const radiosity::Discretization& discretization)
    : discretization_(discretization),
      rays_(scene),
      pieces_(surfacePieces(scene, discretization)),
      seen_(withImages(pieces_, scene)),
      triangles_(sceneTriangles(scene)) {}

MeasuredRow RayFormFactors::overHemisphere(const RaySource& raySource, const Receivers& receivers,
                                           const Sampling& sampling) const {
  const std::size_t back = receivers.count, background = back + 1;
  const auto columnOf = [&](const std::optional<RayHit>& hit) -> std::size_t {
    if (!hit) return background;
    const std::uint32_t element = elementAt(triangles_[hit->triangle], discretization_, hit->weights);
    const std::uint32_t receiver = receivers.ofElement[element];
    return receiver == Receivers::none ? background : hit->front ? receiver : back;
  };
  const auto add = [&](const SamplePoint& sample, Sums& sums) {
    const ShootingPoint point = shootingPoint(raySource, sample[2], sample[3]);
    const glm::dvec3 direction = cosineDirection(point.normal, sample[0], sample[1]);
    sums[columnOf(rays_.firstHit({point.position, direction, point.triangle}))] += 1;
  };
  MeasuredRow row = measure(receivers.count, sampling, add);
  for (Measurement& receiver : row.receivers)
    receiver.standardError = std::max(receiver.standardError, fewestRays / sampling.samples);
  return row;
}

MeasuredRow RayFormFactors::aimed(const RaySource& raySource, const Receivers& receivers,
                                  const Sampling& sampling) const {
  const std::size_t back = receivers.count, background = back + 1;
  std::vector<const SurfacePiece*> asked;
  for (const SurfacePiece& piece : seen_.pieces)
    if (receivers.ofElement[piece.element] != Receivers::none) asked.push_back(&piece);
  const auto add = [&](const SamplePoint& sample, Sums& sums) {
    const ShootingPoint point = shootingPoint(raySource, sample[0], sample[1]);
    double left = 1;
    for (const SurfacePiece* piece : asked) {
      const std::optional<SeenSide> side = seenSide(*piece, point);
      if (!side || (!side->front && triangles_[piece->triangle].isBacked)) continue;
      const double whole = pointToPolygon(point.position, point.normal, side->polygon, closedFormError);
      if (whole == 0) continue;
      const double seen = whole - hiddenFactor(rays_, point, side->polygon, piece->triangle, sample[2], sample[3]);
      sums[side->front ? receivers.ofElement[piece->element] : back] += seen;
      left -= seen;
    }
    sums[background] += left;
  };
  return measure(receivers.count, sampling, add);
}

}  // namespace hemitex::reference
