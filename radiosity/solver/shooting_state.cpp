#include "radiosity/solver/shooting_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// One past the last element of a surface.
std::uint32_t endOf(const Grid& grid) { return grid.firstElement + grid.elementCount; }

/// Entries [first, end) of a row.
struct Part {
  std::size_t first = 0, end = 0;
};

/// Divides a row into parts, one per task: some thousand entries each, ending at the end of a surface. The parts depend
/// only on the row, so that the order of sums does too.
std::vector<Part> partsOf(const FormFactorRow& row, const Discretization& discretization) {
  constexpr std::size_t entries = 2048;
  std::vector<Part> parts;
  for (std::size_t first = 0, end = 0; first < row.elements.size(); first = end) {
    const auto last =
        row.elements.begin() + static_cast<std::ptrdiff_t>(std::min(first + entries, row.elements.size()) - 1);
    const Grid& grid = discretization.grids[discretization.elements[*last].surface];
    const auto behind = std::lower_bound(last, row.elements.end(), endOf(grid));
    end = static_cast<std::size_t>(behind - row.elements.begin());
    parts.push_back({first, end});
  }
  return parts;
}

/// Number of elements to prefetch, because the elements of a row are far apart in memory.
constexpr std::size_t fetchedAhead = 32;

/// Entries of a row in one surface, and the flux shot along the row.
template <std::size_t bands>
struct Arrival {
  std::uint32_t surface;
  std::size_t count;                        ///< of entries in the surface
  std::span<const std::uint32_t> elements;  ///< of these, and then of all later entries, for prefetching
  std::span<const std::uint64_t> shares;
  std::span<const double, bands> shot;
  double unitsPerFlux;  ///< 0 if the surface is not seen
};

/// The flux that an element absorbs of what it received, bands summed.
double absorbedSum(std::span<const double> received, std::span<const double> reflectance) {
  double sum = 0;
  for (std::size_t band = 0; band < received.size(); ++band) sum += received[band] * (1.0 - reflectance[band]);
  return sum;
}

/// The same in whole units.
std::int64_t absorbedUnits(std::span<const double> received, std::span<const double> reflectance, double unitsPerFlux) {
  return static_cast<std::int64_t>(absorbedSum(received, reflectance) * unitsPerFlux);
}

/// The unshot flux of receiving patches, and their tree blocks.
class ReceivingPatches {
 public:
  ReceivingPatches(UnshotTree& unshot, std::vector<std::uint32_t>& blocks) : unshot_(unshot), blocks_(blocks) {}

  /// The unshot flux of a patch, to change.
  std::span<double> operator[](std::uint32_t patch) {
    const std::uint32_t block = patch / UnshotTree::patchesInBlock;
    if (block != last_) blocks_.push_back(last_ = block);
    return unshot_.ofPatch(patch);
  }

 private:
  UnshotTree& unshot_;
  std::vector<std::uint32_t>& blocks_;
  std::uint32_t last_ = std::numeric_limits<std::uint32_t>::max();
};

/// Adds what is reflected of the flux times a factor.
template <std::size_t bands>
void addReflected(std::span<double> sum, std::span<const double, bands> flux, double factor,
                  std::span<const double> reflectance) {
  for (std::size_t band = 0; band < flux.size(); ++band) sum[band] += flux[band] * factor * reflectance[band];
}

/// Adds the arriving flux to elements, and calls reflect(i, factor) for the form factor of the i-th entry. Returns the
/// units that a seen surface absorbs.
template <std::size_t bands, typename Reflect>
std::int64_t receive(const Arrival<bands>& arrival, const ElementMaterials& materials, BandTable& received,
                     const Reflect& reflect) {
  const std::span elements = arrival.elements;
  const auto unitsOf = [&](std::uint32_t element) {
    return absorbedUnits(std::as_const(received)[element], materials.reflectance(arrival.surface, element),
                         arrival.unitsPerFlux);
  };
  const bool isSeen = arrival.unitsPerFlux > 0;
  std::int64_t units = 0;
  for (std::size_t i = 0; i < arrival.count; ++i) {
    if (i + fetchedAhead < elements.size()) __builtin_prefetch(received[elements[i + fetchedAhead]].data(), 1);
    const double factor = formFactor(arrival.shares[i]);
    if (isSeen) units -= unitsOf(elements[i]);
    addTo<bands>(received.of<bands>(elements[i]), arrival.shot, factor);
    if (isSeen) units += unitsOf(elements[i]);
    reflect(i, factor);
  }
  return units;
}

/// Adds the reflected flux of each element to its patch.
template <std::size_t bands>
std::int64_t receiveByElements(const Arrival<bands>& arrival, const ElementMaterials& materials,
                               std::span<const std::uint32_t> patchOf, BandTable& received, ReceivingPatches patches) {
  return receive(arrival, materials, received, [&](std::size_t i, double factor) {
    const std::uint32_t element = arrival.elements[i];
    addReflected(patches[patchOf[element]], arrival.shot, factor, materials.reflectance(arrival.surface, element));
  });
}

/// Contents are ignored; the allocations are reused.
struct PatchSums {
  std::vector<std::uint64_t> shareOf;  ///< one per patch of a surface
  Bands reflected;
};

/// As above for a uniform reflectance and patches with several receiving elements: sums the shares per patch first,
/// except for patches made by splits.
template <std::size_t bands>
std::int64_t receiveByPatches(const Arrival<bands>& arrival, const ElementMaterials& materials, const Grid& grid,
                              std::span<const std::uint32_t> patchOf, BandTable& received, ReceivingPatches patches,
                              PatchSums& sums) {
  const std::span<const double> reflectance = materials.reflectance(arrival.surface, grid.firstElement);
  std::vector<std::uint64_t>& shareOf = sums.shareOf;
  shareOf.assign(grid.patchCount, 0);
  const std::int64_t units = receive(arrival, materials, received, [&](std::size_t i, double factor) {
    const std::uint32_t patch = patchOf[arrival.elements[i]];
    if (patch - grid.firstPatch < shareOf.size())
      shareOf[patch - grid.firstPatch] += arrival.shares[i];
    else
      addReflected(patches[patch], arrival.shot, factor, reflectance);
  });
  sums.reflected.assign(arrival.shot.size(), 0);
  addReflected(sums.reflected, arrival.shot, 1, reflectance);
  for (std::uint32_t p = 0; p < grid.patchCount; ++p)
    if (shareOf[p] != 0) addTo(patches[grid.firstPatch + p], sums.reflected, formFactor(shareOf[p]));
  return units;
}

/// The effects of a part of a row.
struct Receipt {
  std::vector<std::uint32_t> blocks;  ///< of receiving patches
  std::size_t visits = 0;             ///< number of elements and patches visited
  std::int64_t seenUnits = 0;         ///< absorbed by seen surfaces
};

/// The surfaces whose absorbed flux is summed.
struct SeenSurfaces {
  const std::vector<bool>& surfaces;  ///< one per surface, or none
  double unitsPerFlux;
};

/// Applies a shot to all entries of a part, surface by surface.
template <std::size_t bands>
Receipt receive(const Part& part, std::span<const double, bands> shot, const FormFactorRow& row,
                const SeenSurfaces& seen, const ElementMaterials& materials, const Discretization& discretization,
                std::span<const std::uint32_t> patchOf, BandTable& received, UnshotTree& unshot) {
  Receipt receipt{.blocks = {}, .visits = part.end - part.first, .seenUnits = 0};
  PatchSums sums;
  for (std::size_t first = part.first, end = part.first; first < part.end; first = end) {
    const std::uint32_t surface = discretization.elements[row.elements[first]].surface;
    const Grid& grid = discretization.grids[surface];
    while (end < part.end && row.elements[end] < endOf(grid)) ++end;
    const std::size_t count = end - first;
    const Arrival<bands> arrival{surface,
                                 count,
                                 std::span(row.elements).subspan(first),
                                 std::span(row.shares).subspan(first, count),
                                 shot,
                                 !seen.surfaces.empty() && seen.surfaces[surface] ? seen.unitsPerFlux : 0};
    const ReceivingPatches patches(unshot, receipt.blocks);
    // The pass over patches must not be longer than that over entries: a row may contain few elements of a large
    // surface.
    if (!materials.hasReflectanceMaps() && grid.patchCount <= count / 2) {
      receipt.seenUnits += receiveByPatches(arrival, materials, grid, patchOf, received, patches, sums);
      receipt.visits += grid.patchCount;
    } else {
      receipt.seenUnits += receiveByElements(arrival, materials, patchOf, received, patches);
    }
  }
  return receipt;
}

}  // namespace

ShotLight nothingShot(const Patches& patches, std::size_t bands, OutsideFlux outside) {
  ShotLight light{BandTable(patches.list.size(), bands), outside.received, Bands(bands), Bands(bands)};
  if (outside.received.empty()) light.received = BandTable(patches.ofElement.size(), bands);
  addTo(light.lost, outside.lost);
  addTo(light.lostToBacks, outside.lostToBacks);
  light.outside = std::move(outside);
  return light;
}

ShootingState::ShootingState(const Scene& scene, const Discretization& discretization, Patches patches, ShotLight light)
    : discretization_(discretization),
      materials_(scene, discretization),
      patches_(std::move(patches)),
      light_(std::move(light)),
      unshot_(unshotByPatches()),
      emitted_(emittedFlux(discretization, materials_)),
      lost_(materials_.bands()),
      lostToBacks_(materials_.bands()) {
  addTo(emitted_, sumOf(light_.outside));
  if (bandSum(emitted_) > 0) light_.lastEmitted = bandSum(emitted_);
  lost_.add(light_.lost);
  lostToBacks_.add(light_.lostToBacks);
}

ShootingState::ShootingState(const Scene& scene, const Discretization& discretization, Patches patches, ShotLight begun,
                             SavedShots saved)
    : discretization_(discretization),
      materials_(scene, discretization),
      patches_(std::move(patches)),
      light_{std::move(saved.shot), std::move(saved.received), saved.lost.sum,          saved.lostToBacks.sum,
             begun.stale,           begun.lastEmitted,         std::move(begun.outside)},
      unshot_(std::move(saved.unshot)),
      emitted_(emittedFlux(discretization, materials_)),
      lost_(std::move(saved.lost)),
      lostToBacks_(std::move(saved.lostToBacks)) {
  addTo(emitted_, sumOf(light_.outside));
  if (bandSum(emitted_) > 0) light_.lastEmitted = bandSum(emitted_);
}

SavedShots ShootingState::saved() const { return {light_.shot, light_.received, unshot_.flux(), lost_, lostToBacks_}; }

std::size_t ShootingState::shoot(std::uint32_t patch, const FormFactorRow& row) {
  const std::span<double> unshot = unshot_.ofPatch(patch);
  const Bands shot(unshot.begin(), unshot.end());
  addTo(light_.shot[patch], shot);
  std::fill(unshot.begin(), unshot.end(), 0.0);
  const std::vector<Part> parts = partsOf(row, discretization_);
  std::vector<Receipt> receipts(parts.size());
  // Patches belong to one surface, so that no two threads change the same patch.
  raster::parallelFor(parts.size(), [&](std::size_t i) {
    const auto receiveShot = [&]<std::size_t bands>(std::span<const double, bands> flux) {
      return receive(parts[i], flux, row, {seen_, unitsPerFlux_}, materials_, discretization_, patches_.ofElement,
                     light_.received, unshot_);
    };
    receipts[i] = shot.size() == 3 ? receiveShot(std::span<const double, 3>(shot.data(), 3))
                                   : receiveShot(std::span<const double>(shot));
  });
  std::vector<std::uint32_t> blocks{patch / UnshotTree::patchesInBlock};
  std::size_t visits = 0;
  for (const Receipt& receipt : receipts) {
    blocks.insert(blocks.end(), receipt.blocks.begin(), receipt.blocks.end());
    visits += receipt.visits;
    seenUnits_ += receipt.seenUnits;
  }
  lost_.add(shot, formFactor(row.background + row.back));
  lostToBacks_.add(shot, formFactor(row.back));
  light_.lost = lost_.sum;
  light_.lostToBacks = lostToBacks_.sum;
  return visits + unshot_.update(blocks);
}

Energy ShootingState::energy() const {
  KahanSum unshot(materials_.bands());
  for (std::size_t p = 0; p < unshot_.flux().size(); ++p) unshot.add(unshot_.flux()[p]);
  Bands onBacks = light_.outside.onBacks;
  onBacks.resize(materials_.bands());
  return {emitted_, absorbed(), unshot.sum, lost_.sum, lostToBacks_.sum, onBacks};
}

/// The flux that the elements received and do not reflect. Short sums are plain sums, which are four times as fast and
/// lose at most one digit.
Bands ShootingState::absorbed() const {
  constexpr std::uint32_t summedPlainly = 64;
  std::vector<Bands> ofSurfaces(discretization_.grids.size());
  raster::parallelFor(ofSurfaces.size(), [&](std::size_t s) {
    const Grid& grid = discretization_.grids[s];
    KahanSum sum(materials_.bands());
    for (std::uint32_t first = grid.firstElement; first < endOf(grid); first += summedPlainly) {
      Bands some(materials_.bands());
      for (std::uint32_t e = first; e < std::min(first + summedPlainly, endOf(grid)); ++e) {
        const std::span<const double> received = light_.received[e],
                                      reflectance = materials_.reflectance(static_cast<std::uint32_t>(s), e);
        for (std::size_t band = 0; band < some.size(); ++band)
          some[band] += received[band] - received[band] * reflectance[band];
      }
      sum.add(some);
    }
    ofSurfaces[s] = sum.sum;
  });
  KahanSum sum(materials_.bands());
  for (const Bands& ofSurface : ofSurfaces) sum.add(ofSurface);
  return sum.sum;
}

double ShootingState::residual() const {
  return light_.lastEmitted > 0 ? (bandSum(unshot_.sizes()) + light_.stale) / light_.lastEmitted : 0;
}

void ShootingState::setSeen(std::vector<bool> surfaces) {
  constexpr int bits = 52;  // of the emitted flux, which is about all that is ever absorbed
  seen_ = std::move(surfaces);
  unitsPerFlux_ = light_.lastEmitted > 0 ? std::ldexp(1.0, bits - std::ilogb(light_.lastEmitted)) : 1;
  seenUnits_ = 0;
  for (std::uint32_t s = 0; s < seen_.size(); ++s) {
    if (!seen_[s]) continue;
    for (const std::uint32_t element : elementsOf(discretization_.grids[s]))
      seenUnits_ += absorbedUnits(light_.received[element], materials_.reflectance(s, element), unitsPerFlux_);
  }
}

double ShootingState::seenResidual() const {
  if (std::find(seen_.begin(), seen_.end(), true) == seen_.end()) return 0;
  if (seenUnits_ == 0) return std::numeric_limits<double>::infinity();
  double unshot = 0;
  for (std::size_t p = 0; p < patches_.list.size(); ++p)
    if (seen_[patches_.list[p].surface]) unshot += sizeSum(unshot_.flux()[p]);
  return unshot / (static_cast<double>(seenUnits_) / unitsPerFlux_);
}

double ShootingState::seenShare() const {
  if (std::find(seen_.begin(), seen_.end(), true) == seen_.end()) return std::numeric_limits<double>::infinity();
  if (light_.lastEmitted == 0) return 0;
  return static_cast<double>(seenUnits_) / unitsPerFlux_ / light_.lastEmitted;
}

double ShootingState::seenGain(std::uint32_t patch, const FormFactorRow& row) const {
  Bands flux(unshot(patch).begin(), unshot(patch).end());
  for (double& value : flux) value = std::abs(value);
  double gain = 0;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const std::uint32_t element = row.elements[i], surface = discretization_.elements[element].surface;
    if (seen_[surface]) gain += absorbedSum(flux, materials_.reflectance(surface, element)) * formFactor(row.shares[i]);
  }
  return gain > 0 ? gain / (gain + static_cast<double>(seenUnits_) / unitsPerFlux_) : 0;
}

BandTable ShootingState::irradiance() const {
  BandTable irradiance(light_.received);
  for (std::size_t e = 0; e < irradiance.size(); ++e)
    for (double& value : irradiance[e]) value /= discretization_.elements[e].area;
  return irradiance;
}

BandTable ShootingState::radiosity() && {
  raster::parallelFor(discretization_.grids.size(), [&](std::size_t s) {
    const auto surface = static_cast<std::uint32_t>(s);
    for (const std::uint32_t element : elementsOf(discretization_.grids[s])) {
      const double area = discretization_.elements[element].area;
      const std::span<const double> emission = materials_.emission(surface, element),
                                    reflectance = materials_.reflectance(surface, element);
      const std::span<double> values = light_.received[element];
      for (std::size_t band = 0; band < values.size(); ++band)
        values[band] = (emission[band] * area + reflectance[band] * values[band]) / area;
    }
  });
  return std::move(light_.received);
}

/// The outgoing flux of a patch's elements minus what the patch has shot.
Bands ShootingState::unshotOf(std::uint32_t number) const {
  const Patch& patch = patches_.list[number];
  KahanSum sum(materials_.bands());
  sum.add(light_.shot[number], -1);
  Bands outgoing(materials_.bands());
  for (const std::uint32_t element : patch.elements) {
    const std::span<const double> emission = materials_.emission(patch.surface, element),
                                  reflectance = materials_.reflectance(patch.surface, element),
                                  received = light_.received[element];
    for (std::size_t band = 0; band < outgoing.size(); ++band)
      outgoing[band] = emission[band] * discretization_.elements[element].area + reflectance[band] * received[band];
    sum.add(outgoing);
  }
  return sum.sum;
}

BandTable ShootingState::unshotByPatches() const {
  assert(light_.shot.size() == patches_.list.size());
  assert(light_.received.size() == discretization_.elements.size());
  BandTable unshot(light_.shot.size(), materials_.bands());
  raster::parallelFor(unshot.size(),
                      [&](std::size_t patch) { set(unshot[patch], unshotOf(static_cast<std::uint32_t>(patch))); });
  return unshot;
}

void ShootingState::split(std::uint32_t number, std::vector<Patch> parts) {
  assert(!hasShot(number));
  const auto firstNew = static_cast<std::uint32_t>(patches_.list.size());
  replacePatch(patches_, number, std::move(parts));
  const auto end = static_cast<std::uint32_t>(patches_.list.size());
  if (end == firstNew) return;
  light_.shot.resize(end);
  unshot_.grow(end);
  std::vector<std::uint32_t> blocks;
  const auto makeAnew = [&](std::uint32_t changed) {
    set(unshot_.ofPatch(changed), unshotOf(changed));
    blocks.push_back(changed / UnshotTree::patchesInBlock);
  };
  makeAnew(number);
  for (std::uint32_t patch = firstNew; patch < end; ++patch) makeAnew(patch);
  unshot_.update(blocks);
}

}  // namespace hemitex::radiosity
