/// Form factors with occlusion, measured by rays: the ground truth that every other method is compared with. Each value
/// comes with its standard error. From a point, or averaged over the area of elements (see ray_source.h), to elements
/// or to groups of them.
///
/// Two estimators:
/// - Over the hemisphere, rays leave evenly in projected solid angle, so each that arrives counts alike. A row costs
/// the
///   same whatever the number of receivers. Use it for whole rows, and as the judge of the other: it shares nothing
///   with closed forms. Standard errors are about 1e-3 with 2^16 rays and 1e-4 with 2^20; a receiver that fewer than
///   some twenty rays meet is measured badly.
/// - Aimed: at each point of the source the form factor of every receiver is known in closed form but for its
/// blockers,
///   and a ray towards it says whether there are any. Where nothing is hidden only the average over the source is
///   sampled, which is smooth: standard errors of 1e-5 of the value with 2^16 points, 1e-6 with 2^20. Where a blocker
///   hides a part, 1e-3 and 1e-4. What happens on less of the source than one point stands for may be missed, and no
///   standard error tells: at a gap of a millionth of the side it is the light that leaves between the rims, 2e-6 of
///   all. Time grows with points times pieces of receivers. Use it for few, small or near receivers, and where digits
///   count. A value that is 0, for all is hidden, may come out below 0 by its error.
///
/// Faces that lie on each other do not see each other (the epsilon rule): what leaves the floor under a box meets the
/// backs of the box's sides.
///
/// The same bits for any number of threads; rays make no promise between machines.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/closed_forms/surface_pieces.h"
#include "reference/rays/ray_caster.h"
#include "reference/rays/ray_source.h"
#include "reference/rays/sample_points.h"

namespace hemitex::reference {

/// What form factors go to: groups of elements, numbered from 0.
struct Receivers {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> ofElement;  ///< the receiver that each element belongs to, or `none`
  static constexpr std::uint32_t none = 0xffffffff;
};

/// Every element by itself.
Receivers everyElement(const radiosity::Discretization& discretization);
/// One element alone; what reaches others counts as background.
Receivers onlyElement(const radiosity::Discretization& discretization, std::uint32_t element);

struct Sampling {
  int samples = 1 << 16;  ///< rays or points in all, 64 or more; 32 times a power of two is best, others are rounded up
  std::uint32_t seed = 0;  ///< others give other, independent estimates
};

struct MeasuredRow {
  std::vector<Measurement> receivers;
  Measurement back;        ///< absorbed by the backs of surfaces
  Measurement background;  ///< the rest: it left the scene, or reached what is not asked for
};

class RayFormFactors {
 public:
  /// The referenced objects must outlive this one.
  RayFormFactors(const radiosity::Scene& scene, const radiosity::Discretization& discretization);

  MeasuredRow overHemisphere(const RaySource& raySource, const Receivers& receivers, const Sampling& sampling) const;
  MeasuredRow aimed(const RaySource& raySource, const Receivers& receivers, const Sampling& sampling) const;

  /// For shooters made of elements.
  const SurfacePieces& pieces() const { return pieces_; }

 private:
  const radiosity::Scene& scene_;
  const radiosity::Discretization& discretization_;
  RayCaster rays_;
  SurfacePieces pieces_;
  struct Place {
    std::uint32_t surface, triangle;  ///< in Scene::surfaces, in Surface::triangles
  };
  std::vector<Place> places_;  ///< of every triangle of the scene
};

}  // namespace hemitex::reference
