#include "reference/truth/rays/ray_caster.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "reference/truth/closed_forms/surface_pieces.h"
#include "reference/truth/rays/embree_scene.h"

namespace hemitex::reference {
namespace {

/// The margin of boxes around their triangles, and of rays beyond their hits, in extents. Coordinates are at most 1/2,
/// so that binary32 starts, directions and boxes each have an error of at most 2^-24.
constexpr float boxMargin = 0x1p-20F;

/// The rounding error of a product of a unit direction and two vectors, over their lengths.
constexpr double edgeRounding = 0x1p-50;

struct Target {
  std::array<glm::dvec3, 3> corner;  ///< in the frame of the scene
  bool hasTwin = false;              ///< rays pass through its back
};

/// A ray and its hit during a query. Embree passes it to `ask` by the address of the embedded context.
struct Query : RTCIntersectContext {
  Ray ray;
  std::optional<RayHit> hit;
  double distance = std::numeric_limits<double>::infinity();  ///< to the hit, in epsilons
};

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
  if (sum == 0 || !inside || (!front && target.hasTwin)) return std::nullopt;
  const glm::dvec3 normal = glm::cross(b - a, c - a);
  const double distance = std::nearbyint(glm::dot(a, normal) / glm::dot(ray.direction, normal) / rayEpsilon);
  if (!(distance > 0 && std::isfinite(distance))) return std::nullopt;
  return Meeting{{number, glm::dvec2(atB, atC) / sum, front}, distance};
}

void giveBounds(const RTCBoundsFunctionArguments* arguments) {
  const auto& corner = static_cast<const Target*>(arguments->geometryUserPtr)[arguments->primID].corner;
  const glm::vec3 low = glm::vec3(glm::min(glm::min(corner[0], corner[1]), corner[2])) - boxMargin;
  const glm::vec3 high = glm::vec3(glm::max(glm::max(corner[0], corner[1]), corner[2])) + boxMargin;
  *arguments->bounds_o = {low.x, low.y, low.z, 0, high.x, high.y, high.z, 0};
}

/// The intersection callback of Embree for each box that a ray enters.
void ask(const RTCIntersectFunctionNArguments* arguments) {
  auto& query = *static_cast<Query*>(arguments->context);
  const std::uint32_t number = arguments->primID;
  if (number == query.ray.triangle) return;
  const auto met = meet(query.ray, static_cast<const Target*>(arguments->geometryUserPtr)[number], number);
  if (!met || met->distance > query.distance) return;
  if (met->distance == query.distance && query.hit->triangle < number) return;
  query.hit = met->hit;
  query.distance = met->distance;
  // A single ray is passed as a packet of one, which has the layout of a single ray.
  reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray.tfar =
      static_cast<float>(met->distance * rayEpsilon) + boxMargin;
}

std::vector<Target> targetsOf(const radiosity::Scene& scene) {
  std::vector<Target> targets;
  for (const SceneTriangle& triangle : sceneTriangles(scene))
    targets.push_back({inFrame(scene, *triangle.triangle), triangle.hasTwin});
  return targets;
}

/// `targets` must live as long as the tree.
EmbreeScene treeOver(std::vector<Target>& targets) {
  return embreeTree([&targets](RTCDevice device) {
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(targets.size()));
    rtcSetGeometryUserData(geometry, targets.data());
    rtcSetGeometryBoundsFunction(geometry, giveBounds, nullptr);
    rtcSetGeometryIntersectFunction(geometry, ask);
    return geometry;
  });
}

}  // namespace

struct RayCaster::Implementation {
  explicit Implementation(const radiosity::Scene& scene) : targets(targetsOf(scene)), tree(treeOver(targets)) {}

  std::vector<Target> targets;
  EmbreeScene tree;
};

RayCaster::RayCaster(const radiosity::Scene& scene) : implementation_(std::make_shared<Implementation>(scene)) {}

std::optional<RayHit> RayCaster::firstHit(const Ray& ray) const {
  Query query;
  rtcInitIntersectContext(&query);
  query.ray = ray;
  RTCRayHit embree{};
  embree.ray.org_x = static_cast<float>(ray.start.x);
  embree.ray.org_y = static_cast<float>(ray.start.y);
  embree.ray.org_z = static_cast<float>(ray.start.z);
  embree.ray.dir_x = static_cast<float>(ray.direction.x);
  embree.ray.dir_y = static_cast<float>(ray.direction.y);
  embree.ray.dir_z = static_cast<float>(ray.direction.z);
  embree.ray.tfar = std::numeric_limits<float>::infinity();
  embree.ray.mask = ~0U;
  embree.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(implementation_->tree.scene.get(), &query, &embree);
  return query.hit;
}

}  // namespace hemitex::reference
