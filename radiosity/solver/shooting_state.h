/// The state of progressive refinement (Cohen, Chen, Wallace and Greenberg 1988), in flux, which is radiosity times
/// area.
///
/// Let T_p be the flux that patch p has shot along its row, and S_e the flux that element e receives from outside the
/// scene and from lamps that are points. Element e received I_e = S_e + sum_p F_pe T_p and sends out E_e + rho_e I_e.
/// The part of a patch's outgoing flux that T_p does not include yet is unshot. This holds whatever was shot. So a
/// solution can be continued after a change of emission, reflectances or rows: the same sums with the new E, rho and F
/// give the new unshot flux. It is negative where the change removed light, and shooting negative flux retracts the
/// excess (Chen 1990, George, Sillion and Greenberg 1990).
///
/// A patch shoots the sum of its elements' unshot flux along one row, so that only this sum matters. The residual is
/// the sum of the absolute values of these sums over patches. It bounds the error, because unshot flux of either sign
/// is absorbed or lost. With I* the received flux of the exact solution,
///
///     sum_e (1 - rho_e) |I*_e - I_e|  <=  sum_p |unshot_p|
///
/// so the absorbed flux of two solutions of the same scene differs by at most the sum of both residuals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "radiosity/base/bands.h"
#include "radiosity/base/kahan_sum.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/discretization/element_materials.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/form_factors/outside_flux.h"
#include "radiosity/scene/scene.h"
#include "radiosity/solver/unshot_tree.h"

namespace hemitex::radiosity {

/// Flux in W per band. emitted = absorbed + unshot + lost.
struct Energy {
  Bands emitted;  ///< by elements and lamps, and what elements receive from outside
  Bands absorbed;
  Bands unshot;       ///< signed: flux to be retracted lowers it
  Bands lost;         ///< left the scene or was absorbed by backs
  Bands lostToBacks;  ///< part of `lost` that backs absorbed
  Bands skyOnBacks;   ///< from outside, absorbed by backs; in no other number
};

/// The flux that was shot, in W per band, and where it arrived: all that is needed to continue.
struct ShotLight {
  BandTable shot = {};      ///< one per patch
  BandTable received = {};  ///< one per element
  Bands lost = {};          ///< left the scene or was absorbed by backs
  Bands lostToBacks = {};   ///< part of `lost` that backs absorbed
  /// Upper bound of stale flux, bands summed: it was shot along rows that were not updated. Part of the residual.
  double stale = 0;
  double lastEmitted = 0;    ///< bands summed: the reference of the residual when nothing is emitted
  OutsideFlux outside = {};  ///< included in `received`, `lost` and `lostToBacks`
};

/// A state between two shots, with the rounding errors of its sums. Light from outside and stale flux are computed
/// again.
struct SavedShots {
  BandTable shot;      ///< one per patch
  BandTable received;  ///< one per element
  BandTable unshot;    ///< one per patch
  KahanSum lost, lostToBacks;
};

/// The light before the first shot, for a number of bands.
ShotLight nothingShot(const Patches& patches, std::size_t bands, OutsideFlux outside = {});

class ShootingState {
 public:
  /// Continues from light whose account is balanced: sum of `shot` + sumOf(`outside`) = sum of `received` + `lost`. The
  /// patches are those of the discretization, perhaps split; `discretization.patches` are not used. The references must
  /// outlive this object.
  ShootingState(const Scene& scene, const Discretization& discretization, Patches patches, ShotLight light);

  /// Continues from a saved state of the same scene, discretization and patches with the same bits. `begun` is the
  /// light from which that solution began, of which its shots and what they reached are not used.
  ShootingState(const Scene& scene, const Discretization& discretization, Patches patches, ShotLight begun,
                SavedShots saved);
  SavedShots saved() const;

  const Patches& patches() const { return patches_; }
  /// The patch with the largest absolute unshot flux, bands summed; the first of equals.
  std::uint32_t brightestPatch() const { return unshot_.brightest(); }
  /// The patches with the largest absolute unshot flux, in this order; at most `count`.
  std::vector<std::uint32_t> brightestPatches(std::size_t count) const { return unshot_.brightestPatches(count); }
  /// The unshot flux of a patch in W per band, and whether it has ever shot.
  std::span<const double> unshot(std::uint32_t patch) const { return unshot_.flux()[patch]; }
  bool hasShot(std::uint32_t patch) const { return !areZero(light_.shot[patch]); }
  /// Replaces a patch that never shot by parts (see replacePatch). If they are several, they get the unshot flux of
  /// their elements.
  void split(std::uint32_t patch, std::vector<Patch> parts);
  /// Shoots the unshot flux of a patch along its row. Returns the number of elements, patches and tree nodes that it
  /// visited: those of the row, and some near the patches that received.
  std::size_t shoot(std::uint32_t patch, const FormFactorRow& row);

  const ElementMaterials& materials() const { return materials_; }
  const ShotLight& light() const { return light_; }
  /// The account of flux, summed over all elements and patches.
  Energy energy() const;
  /// The sum of absolute unshot flux of all patches and of the stale flux, over the emitted flux, bands summed. If
  /// nothing is emitted, over the flux emitted last; 0 if nothing ever was.
  double residual() const;
  /// Chooses the surfaces that seenResidual and seenGain are about: one value per surface, or none.
  void setSeen(std::vector<bool> surfaces);
  /// As residual, of the seen surfaces alone: the absolute unshot flux of their patches over the flux that they have
  /// absorbed. 0 if none is seen, infinite if they have absorbed nothing.
  double seenResidual() const;
  /// The flux that the seen surfaces have absorbed, over the flux that is the reference of the residual. Infinite if
  /// none is seen, 0 if nothing is emitted.
  double seenShare() const;
  /// The share of the flux absorbed by seen surfaces that the patch would add directly if it shot along `row`; bands
  /// summed. Visits the elements of the row.
  double seenGain(std::uint32_t patch, const FormFactorRow& row) const;
  /// Irradiance of the elements, W/m^2 per band: received flux over area.
  BandTable irradiance() const;
  /// Radiosity of the elements, W/m^2 per band: flux over area. Reuses the memory of the received flux.
  BandTable radiosity() &&;
  /// Moves the patches out. This object must not be used afterwards.
  Patches takePatches() { return std::move(patches_); }

 private:
  Bands absorbed() const;
  Bands unshotOf(std::uint32_t patch) const;
  BandTable unshotByPatches() const;

  const Discretization& discretization_;
  ElementMaterials materials_;
  Patches patches_;
  ShotLight light_;
  UnshotTree unshot_;       ///< one per patch
  std::vector<bool> seen_;  ///< one per surface, or none
  /// Units of flux that the elements of seen surfaces have absorbed, bands summed. Whole numbers have the same sum in
  /// any order, so that it can follow the shots, and is that of a state which was stored.
  std::int64_t seenUnits_ = 0;
  double unitsPerFlux_ = 0;
  Bands emitted_;
  KahanSum lost_, lostToBacks_;
};

}  // namespace hemitex::radiosity
