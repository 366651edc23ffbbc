#include "reference/truth/rays/ray_meeting.h"

#include <algorithm>
#include <cmath>

#include "reference/truth/closed_forms/surface_pieces.h"

namespace hemitex::reference {
namespace {

/// The rounding error of a product of a unit direction and two vectors, over their lengths.
constexpr double edgeRounding = 0x1p-50;

struct Meeting {
  RayHit hit;
  double distance;  ///< in epsilons
};

/// The doubled area, seen along the ray, between its start and an edge from `a` to `b` (relative to the start). The
/// other triangle at the edge gets exactly the opposite value. Values within the rounding error are set to 0, so that a
/// ray through a corner also meets a triangle.
double edgeArea(const glm::dvec3& direction, const glm::dvec3& a, const glm::dvec3& b) {
  const double area = glm::dot(direction, glm::cross(a, b));
  return area * area > edgeRounding * edgeRounding * glm::dot(a, a) * glm::dot(b, b) ? area : 0;
}

/// The hit of a ray and a triangle including its edges. Inside, the three areas have the same sign. Their sum is the
/// component of the direction along the normal.
std::optional<Meeting> meet(const Ray& ray, const Target& target, std::uint32_t number) {
  const glm::dvec3 a = target.corner[0] - ray.start, b = target.corner[1] - ray.start, c = target.corner[2] - ray.start;
  const double atA = edgeArea(ray.direction, b, c), atB = edgeArea(ray.direction, c, a),
               atC = edgeArea(ray.direction, a, b);
  const double sum = (atA + atB) + atC;
  const bool front = sum < 0;
  const bool inside = front ? std::max({atA, atB, atC}) <= 0 : std::min({atA, atB, atC}) >= 0;
  if (sum == 0 || !inside || (!front && target.isBacked)) return std::nullopt;
  const glm::dvec2 weights = glm::dvec2(atB, atC) / sum;
  if (target.holed && radiosity::isHole(*target.holed->cutOut, target.holed->triangle, weights)) return std::nullopt;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double distance = std::nearbyint(glm::dot(a, normal) / glm::dot(ray.direction, normal) / rayEpsilon);
  if (!(distance > 0 && std::isfinite(distance))) return std::nullopt;
  return Meeting{{number, weights, front}, distance};
}

}  // namespace

std::vector<Target> targetsOf(const radiosity::Scene& scene) {
  std::vector<Target> targets;
  for (const SceneTriangle& triangle : sceneTriangles(scene))
    targets.push_back({inFrame(scene, radiosity::placed(scene, triangle.place)), triangle.isBacked, triangle.holed});
  return targets;
}

bool RayQuery::ask(const Target& target, std::uint32_t number) {
  if (number == ray.triangle) return false;
  const auto met = meet(ray, target, number);
  if (!met || met->distance > distance) return false;
  if (met->distance == distance && hit->triangle < number) return false;
  hit = met->hit;
  distance = met->distance;
  return true;
}

std::optional<RayHit> nearestHit(std::span<const Target> targets, const Ray& ray) {
  RayQuery query{ray};
  for (std::uint32_t number = 0; number < targets.size(); ++number) query.ask(targets[number], number);
  return query.hit;
}

}  // namespace hemitex::reference
