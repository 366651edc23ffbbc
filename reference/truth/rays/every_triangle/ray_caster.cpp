// RayCaster in builds without Embree.
#include "reference/truth/rays/ray_caster.h"

#include <vector>

namespace hemitex::reference {

struct RayCaster::Implementation {
  std::vector<Target> targets;
};

RayCaster::RayCaster(const radiosity::Scene& scene)
    : implementation_(std::make_shared<Implementation>(Implementation{targetsOf(scene)})) {}

std::optional<RayHit> RayCaster::firstHit(const Ray& ray) const { return nearestHit(implementation_->targets, ray); }

}  // namespace hemitex::reference
