/// Form factors with occlusion, measured by rays: the ground truth for all other methods. Each value has a standard
/// error. The source is a point or the area of elements (see ray_source.h); receivers are elements or groups of
/// elements.
///
/// There are two estimators:
/// - Over the hemisphere: rays leave uniformly in projected solid angle, so that all arriving rays have the same
///   weight. A row takes the same time for any number of receivers. Use it for whole rows, and to verify the other
///   estimator, because it uses no closed forms. Errors are at most 5e-4 with 2^16 rays, and about five times
///   smaller with 2^20. A receiver that fewer than about twenty rays meet is measured badly.
/// - Aimed: at each point of the source, closed forms give the form factor to each receiver without blockers. A ray
///   towards the receiver tests for blockers. If nothing is hidden, only the smooth average over the source is sampled:
///   errors are at most 2e-5 with 2^13 points. If a blocker hides a part, they are at most 7e-4. Features smaller than
///   a point's share of the source may be missed, and the standard error does not show that. At a gap of a millionth of
///   the side, this is the light that leaves between the rims, 2e-6 of all. Time grows with points times pieces of
///   receivers. Use it for few, small or near receivers, and for high accuracy. A value of 0, for a completely hidden
///   receiver, may be negative within its error.
///
/// These errors are root mean squares over 20 seeds, as shares of all light, for the pairs of rectangles in
/// monte_carlo_form_factors_test.cpp. They do not depend on the number of texels of a rectangle. Standard errors are
/// larger on average, see sample_points.h.
///
/// Faces that touch do not see each other (the epsilon rule). Light from the floor under a box meets the backs of the
/// box's sides.
///
/// The results have the same bits for any number of threads, but not on different machines.
#pragma once

#include <cstdint>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"
#include "reference/truth/closed_forms/surface_pieces.h"
#include "reference/truth/rays/ray_caster.h"
#include "reference/truth/rays/ray_source.h"
#include "reference/truth/rays/sample_points.h"

namespace hemitex::reference {

/// The receivers of form factors: groups of elements, numbered from 0.
struct Receivers {
  std::uint32_t count = 0;
  std::vector<std::uint32_t> ofElement;  ///< the receiver of each element, or `none`
  static constexpr std::uint32_t none = 0xffffffff;
};

/// Each element is a receiver.
Receivers everyElement(const radiosity::Discretization& discretization);

struct Sampling {
  int samples =
      1 << 16;  ///< total number of rays or points, at least 64; 32 times a power of two is best, others are rounded up
  std::uint32_t seed = 0;  ///< different seeds give independent estimates; 0 is the default of all commands
};

struct MeasuredRow {
  std::vector<Measurement> receivers;
  Measurement back;        ///< absorbed by the backs of surfaces
  Measurement background;  ///< the rest: left the scene, or reached an element without receiver
};

class RayFormFactors {
 public:
  /// The referenced objects must outlive this one.
  RayFormFactors(const radiosity::Scene& scene, const radiosity::Discretization& discretization);

  MeasuredRow overHemisphere(const RaySource& raySource, const Receivers& receivers, const Sampling& sampling) const;
  MeasuredRow aimed(const RaySource& raySource, const Receivers& receivers, const Sampling& sampling) const;

  /// For ray sources made of elements.
  const SurfacePieces& pieces() const { return pieces_; }

 private:
  const radiosity::Discretization& discretization_;
  RayCaster rays_;
  SurfacePieces pieces_;
  SurfacePieces seen_;  ///< with images
  std::vector<SceneTriangle> triangles_;
};

}  // namespace hemitex::reference
