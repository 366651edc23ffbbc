#include "reference/truth/rays/ray_caster.h"

#include <limits>
#include <vector>

#include "reference/truth/rays/embree_scene.h"

namespace hemitex::reference {
namespace {

/// The margin of boxes around their triangles, and of rays beyond their hits, in extents. Coordinates are at most 1/2,
/// so that binary32 starts, directions and boxes each have an error of at most 2^-24.
constexpr float boxMargin = 0x1p-20F;

/// Embree passes it to `ask` by the address of the context.
struct Query : RTCIntersectContext, RayQuery {};

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
  if (!query.ask(static_cast<const Target*>(arguments->geometryUserPtr)[number], number)) return;
  // A single ray is passed as a packet of one, which has the layout of a single ray.
  reinterpret_cast<RTCRayHit*>(arguments->rayhit)->ray.tfar =
      static_cast<float>(query.distance * rayEpsilon) + boxMargin;
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
