/// The state of progressive refinement (Cohen, Chen, Wallace and Greenberg 1988), in flux: radiosity times area.
///
/// What each patch has shot along its row, T_p, says all: an element received I_e = sum_p F_pe T_p and sends out
/// E_e + rho_e I_e; what a patch's elements send out and T_p does not hold yet is unshot. That is true whatever was
/// shot, so that a solution can be continued after emission, reflectances or rows have changed: with the new E, rho and
/// F the same sums say what is unshot now, and where the change took light away it is below zero. Shooting a negative
/// flux takes back what was too much (Chen 1990, George, Sillion and Greenberg 1990).
///
/// A patch shoots the sum of its elements' unshot flux along one row, so only that sum has anywhere to go; what cancels
/// inside a patch is at its place already. The residual therefore adds up the sizes of the patches' sums. It bounds the
/// error: unshot flux, whatever its sign, is absorbed somewhere or lost, and no more of it than there is. With I* what
/// is received in the end,
///
///     sum_e (1 - rho_e) |I*_e - I_e|  <=  sum_p |unshot_p|
///
/// and two solutions of the same scene differ in what their elements absorb by no more than both residuals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/kahan_sum.h"
#include "radiosity/solver/unshot_tree.h"

namespace hemitex::radiosity {

/// Flux per RGB band. emitted = absorbed + unshot + lost.
struct Energy {
  glm::dvec3 emitted{0.0};
  glm::dvec3 absorbed{0.0};
  glm::dvec3 unshot{0.0};       ///< with its sign: light that is yet to be taken back lowers it
  glm::dvec3 lost{0.0};         ///< left the scene or was absorbed by backs
  glm::dvec3 lostToBacks{0.0};  ///< the part of `lost` that backs absorbed
};

/// What was shot, and where it arrived: all that is needed to continue.
struct ShotLight {
  std::vector<glm::dvec3> shot;      ///< one a patch
  std::vector<glm::dvec3> received;  ///< one an element
  glm::dvec3 lost{0.0};              ///< left the scene or was absorbed by backs
  glm::dvec3 lostToBacks{0.0};       ///< the part of `lost` that backs absorbed
  /// Flux that may lie where it does not belong, for it went along rows that were not brought up to date: at most so
  /// much, bands summed. Part of the residual.
  double astray = 0;
  double lastEmitted = 0;  ///< bands summed: what the residual is set against where all light is out
};

/// What all elements emit.
glm::dvec3 emittedFlux(const Scene& scene, const Discretization& discretization);

class ShootingState {
 public:
  /// Nothing is shot yet. Both must outlive this.
  ShootingState(const Scene& scene, const Discretization& discretization);
  /// Goes on from what was shot, which is accounted for: sum of `shot` = sum of `received` + `lost`.
  ShootingState(const Scene& scene, const Discretization& discretization, ShotLight light);

  /// The patch with the most unshot flux, sizes of the bands summed; the first of equals.
  std::uint32_t brightestPatch() const { return unshot_.brightest(); }
  /// The unshot flux of a patch, and whether it ever shot any.
  const glm::dvec3& unshot(std::uint32_t patch) const { return unshot_.flux()[patch]; }
  bool hasShot(std::uint32_t patch) const { return light_.shot[patch] != glm::dvec3(0); }
  /// After elements of a patch that never shot have become those of new patches, the last ones: gives each of them the
  /// unshot flux of its elements.
  void split(std::uint32_t patch, std::span<const std::uint32_t> newPatches);
  /// Sends the unshot flux of a patch along its row of form factors. Returns how many elements, patches and sums over
  /// patches it looked at: those of the row, and some beside the patches that received.
  std::size_t shoot(std::uint32_t patch, const FormFactorRow& row);

  const ShotLight& light() const { return light_; }
  /// The account, summed afresh over elements and patches.
  Energy energy() const;
  /// The sizes of all patches' unshot flux, and what is astray, over the emitted flux, bands summed. Where nothing is
  /// emitted, over what was emitted last; 0 where nothing ever was.
  double residual() const;
  /// Radiosity of the elements: flux over area.
  std::vector<glm::dvec3> radiosity() const&;
  /// The same, in the memory of what they received.
  std::vector<glm::dvec3> radiosity() &&;

  std::size_t bytes() const;

 private:
  glm::dvec3 absorbed() const;
  void makeRadiosity(std::vector<glm::dvec3>& received) const;
  glm::dvec3 unshotOf(std::uint32_t patch) const;
  std::vector<glm::dvec3> unshotByPatches() const;

  const Scene& scene_;
  const Discretization& discretization_;
  ShotLight light_;
  UnshotTree unshot_;  ///< one a patch
  glm::dvec3 emitted_{0.0};
  KahanSum lost_, lostToBacks_;
};

}  // namespace hemitex::radiosity
