#include "radiosity/solver/shooting_state.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <span>

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
struct Arrival {
  std::span<const std::uint32_t> elements;
  std::span<const std::uint64_t> shares;
  glm::dvec3 shot;
  double unitsPerFlux;  ///< 0 if the surface is not seen
};

/// The flux that an element absorbs of what it received, in whole units.
std::int64_t absorbedUnits(const glm::dvec3& received, const glm::dvec3& reflectance, double unitsPerFlux) {
  return static_cast<std::int64_t>(bandSum(received * (1.0 - reflectance)) * unitsPerFlux);
}

/// The unshot flux of receiving patches, and their tree blocks.
class ReceivingPatches {
 public:
  ReceivingPatches(UnshotTree& unshot, std::vector<std::uint32_t>& blocks) : unshot_(unshot), blocks_(blocks) {}

  void add(std::uint32_t patch, const glm::dvec3& flux) {
    unshot_.add(patch, flux);
    const std::uint32_t block = patch / UnshotTree::patchesInBlock;
    if (block != last_) blocks_.push_back(last_ = block);
  }

 private:
  UnshotTree& unshot_;
  std::vector<std::uint32_t>& blocks_;
  std::uint32_t last_ = std::numeric_limits<std::uint32_t>::max();
};

/// Adds the arriving flux to elements, and calls reflect(i, light) for that of the i-th entry. Returns the units that
/// a seen surface absorbs.
template <typename Reflect>
std::int64_t receive(const Arrival& arrival, const SurfaceValues& reflectance, std::span<glm::dvec3> received,
                     const Reflect& reflect) {
  const std::span elements = arrival.elements;
  const auto unitsOf = [&](std::uint32_t element) {
    return absorbedUnits(received[element], reflectance.of(element), arrival.unitsPerFlux);
  };
  const bool isSeen = arrival.unitsPerFlux > 0;
  std::int64_t units = 0;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (i + fetchedAhead < elements.size()) __builtin_prefetch(&received[elements[i + fetchedAhead]], 1);
    const glm::dvec3 light = arrival.shot * formFactor(arrival.shares[i]);
    if (isSeen) units -= unitsOf(elements[i]);
    received[elements[i]] += light;
    if (isSeen) units += unitsOf(elements[i]);
    reflect(i, light);
  }
  return units;
}

/// Adds the reflected flux of each element to its patch.
std::int64_t receiveByElements(const Arrival& arrival, const SurfaceValues& reflectance,
                               std::span<const std::uint32_t> patchOf, std::span<glm::dvec3> received,
                               ReceivingPatches patches) {
  return receive(arrival, reflectance, received,
                 [&, elements = arrival.elements](std::size_t i, const glm::dvec3& light) {
                   patches.add(patchOf[elements[i]], light * reflectance.of(elements[i]));
                 });
}

/// As above for a uniform reflectance and patches with several receiving elements: sums the shares per patch first,
/// except for patches made by splits.
std::int64_t receiveByPatches(const Arrival& arrival, const SurfaceValues& reflectances, const Grid& grid,
                              std::span<const std::uint32_t> patchOf, std::span<glm::dvec3> received,
                              ReceivingPatches patches) {
  const glm::dvec3 reflectance = reflectances.of(grid.firstElement);
  std::vector<std::uint64_t> shareOf(grid.patchCount);
  const std::int64_t units =
      receive(arrival, reflectances, received,
              [&, elements = arrival.elements, firstPatch = grid.firstPatch](std::size_t i, const glm::dvec3& light) {
                const std::uint32_t patch = patchOf[elements[i]];
                if (patch - firstPatch < shareOf.size())
                  shareOf[patch - firstPatch] += arrival.shares[i];
                else
                  patches.add(patch, light * reflectance);
              });
  const glm::dvec3 reflected = arrival.shot * reflectance;
  for (std::uint32_t p = 0; p < grid.patchCount; ++p)
    if (shareOf[p] != 0) patches.add(grid.firstPatch + p, reflected * formFactor(shareOf[p]));
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
Receipt receive(const Part& part, const glm::dvec3& shot, const FormFactorRow& row, const SeenSurfaces& seen,
                const Scene& scene, const Discretization& discretization, std::span<const std::uint32_t> patchOf,
                std::span<glm::dvec3> received, UnshotTree& unshot) {
  Receipt receipt{.blocks = {}, .visits = part.end - part.first, .seenUnits = 0};
  for (std::size_t first = part.first, end = part.first; first < part.end; first = end) {
    const std::uint32_t surface = discretization.elements[row.elements[first]].surface;
    const Grid& grid = discretization.grids[surface];
    const auto behind = std::lower_bound(row.elements.begin() + static_cast<std::ptrdiff_t>(first),
                                         row.elements.begin() + static_cast<std::ptrdiff_t>(part.end), endOf(grid));
    end = static_cast<std::size_t>(behind - row.elements.begin());
    const std::size_t count = end - first;
    const Arrival arrival{std::span(row.elements).subspan(first, count), std::span(row.shares).subspan(first, count),
                          shot, !seen.surfaces.empty() && seen.surfaces[surface] ? seen.unitsPerFlux : 0};
    const SurfaceValues reflectance = reflectances(scene, discretization, surface);
    const ReceivingPatches patches(unshot, receipt.blocks);
    // The pass over patches must not be longer than that over entries: a row may contain few elements of a large
    // surface.
    if (reflectance.areEqual() && grid.patchCount <= count / 2) {
      receipt.seenUnits += receiveByPatches(arrival, reflectance, grid, patchOf, received, patches);
      receipt.visits += grid.patchCount;
    } else {
      receipt.seenUnits += receiveByElements(arrival, reflectance, patchOf, received, patches);
    }
  }
  return receipt;
}

}  // namespace

ShotLight nothingShot(const Patches& patches, OutsideFlux outside) {
  ShotLight light;
  light.shot.resize(patches.list.size());
  light.received = outside.received;
  light.received.resize(patches.ofElement.size());
  light.outside = std::move(outside);
  return light;
}

glm::dvec3 emittedFlux(const Scene& scene, const Discretization& discretization) {
  KahanSum sum;
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    const SurfaceValues emission = emissions(scene, discretization, s);
    if (emission.areZero()) continue;
    for (const std::uint32_t element : elementsOf(discretization.grids[s]))
      sum.add(emission.of(element) * discretization.elements[element].area);
  }
  return sum.value();
}

ShootingState::ShootingState(const Scene& scene, const Discretization& discretization, Patches patches, ShotLight light)
    : scene_(scene),
      discretization_(discretization),
      patches_(std::move(patches)),
      light_(std::move(light)),
      unshot_(unshotByPatches()),
      emitted_(emittedFlux(scene, discretization) + sumOf(light_.outside)) {
  if (bandSum(emitted_) > 0) light_.lastEmitted = bandSum(emitted_);
  lost_.add(light_.lost);
  lostToBacks_.add(light_.lostToBacks);
}

ShootingState::ShootingState(const Scene& scene, const Discretization& discretization, Patches patches,
                             OutsideFlux outside, SavedShots saved)
    : scene_(scene),
      discretization_(discretization),
      patches_(std::move(patches)),
      unshot_(std::move(saved.unshot)),
      emitted_(emittedFlux(scene, discretization) + sumOf(outside)),
      lost_(saved.lost),
      lostToBacks_(saved.lostToBacks) {
  light_.shot = std::move(saved.shot);
  light_.received = std::move(saved.received);
  light_.outside = std::move(outside);
  light_.lost = lost_.value();
  light_.lostToBacks = lostToBacks_.value();
  light_.lastEmitted = bandSum(emitted_);
}

SavedShots ShootingState::saved() const { return {light_.shot, light_.received, unshot_.flux(), lost_, lostToBacks_}; }

std::size_t ShootingState::shoot(std::uint32_t patch, const FormFactorRow& row) {
  const glm::dvec3 shot = unshot_.flux()[patch];
  light_.shot[patch] += shot;
  unshot_.clear(patch);
  const std::vector<Part> parts = partsOf(row, discretization_);
  std::vector<Receipt> receipts(parts.size());
  // Patches belong to one surface, so that no two threads change the same patch.
  raster::parallelFor(parts.size(), [&](std::size_t i) {
    receipts[i] = receive(parts[i], shot, row, {seen_, unitsPerFlux_}, scene_, discretization_, patches_.ofElement,
                          light_.received, unshot_);
  });
  std::vector<std::uint32_t> blocks{patch / UnshotTree::patchesInBlock};
  std::size_t visits = 0;
  for (const Receipt& receipt : receipts) {
    blocks.insert(blocks.end(), receipt.blocks.begin(), receipt.blocks.end());
    visits += receipt.visits;
    seenUnits_ += receipt.seenUnits;
  }
  lost_.add(shot * formFactor(row.background + row.back));
  lostToBacks_.add(shot * formFactor(row.back));
  light_.lost = lost_.value();
  light_.lostToBacks = lostToBacks_.value();
  return visits + unshot_.update(blocks);
}

Energy ShootingState::energy() const {
  KahanSum unshot;
  for (const glm::dvec3& flux : unshot_.flux()) unshot.add(flux);
  return {emitted_, absorbed(), unshot.value(), lost_.value(), lostToBacks_.value(), light_.outside.onBacks};
}

/// The flux that the elements received and do not reflect. Short sums are plain sums, which are four times as fast and
/// lose at most one digit.
glm::dvec3 ShootingState::absorbed() const {
  constexpr std::uint32_t summedPlainly = 64;
  std::vector<glm::dvec3> ofSurfaces(discretization_.grids.size());
  raster::parallelFor(ofSurfaces.size(), [&](std::size_t s) {
    const SurfaceValues reflectance = reflectances(scene_, discretization_, static_cast<std::uint32_t>(s));
    const Grid& grid = discretization_.grids[s];
    KahanSum sum;
    for (std::uint32_t first = grid.firstElement; first < endOf(grid); first += summedPlainly) {
      glm::dvec3 some(0);
      for (std::uint32_t e = first; e < std::min(first + summedPlainly, endOf(grid)); ++e)
        some += light_.received[e] - light_.received[e] * reflectance.of(e);
      sum.add(some);
    }
    ofSurfaces[s] = sum.value();
  });
  KahanSum sum;
  for (const glm::dvec3& ofSurface : ofSurfaces) sum.add(ofSurface);
  return sum.value();
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
    const SurfaceValues reflectance = reflectances(scene_, discretization_, s);
    for (const std::uint32_t element : elementsOf(discretization_.grids[s]))
      seenUnits_ += absorbedUnits(light_.received[element], reflectance.of(element), unitsPerFlux_);
  }
}

double ShootingState::seenResidual() const {
  double unshot = 0;
  for (std::size_t p = 0; p < patches_.list.size() && !seen_.empty(); ++p)
    if (seen_[patches_.list[p].surface]) unshot += bandSum(glm::abs(unshot_.flux()[p]));
  return unshot > 0 ? unshot / (static_cast<double>(seenUnits_) / unitsPerFlux_) : 0;
}

double ShootingState::seenGain(std::uint32_t patch, const FormFactorRow& row) const {
  const glm::dvec3 flux = glm::abs(unshot(patch));
  double gain = 0;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const std::uint32_t element = row.elements[i], surface = discretization_.elements[element].surface;
    if (!seen_[surface]) continue;
    const glm::dvec3& reflectance = reflectances(scene_, discretization_, surface).of(element);
    gain += bandSum(flux * (1.0 - reflectance)) * formFactor(row.shares[i]);
  }
  return gain > 0 ? gain / (gain + static_cast<double>(seenUnits_) / unitsPerFlux_) : 0;
}

std::vector<glm::dvec3> ShootingState::irradiance() const {
  std::vector<glm::dvec3> irradiance(light_.received);
  for (std::size_t e = 0; e < irradiance.size(); ++e) irradiance[e] /= discretization_.elements[e].area;
  return irradiance;
}

std::vector<glm::dvec3> ShootingState::radiosity() && {
  raster::parallelFor(discretization_.grids.size(), [&](std::size_t s) {
    const auto surface = static_cast<std::uint32_t>(s);
    const SurfaceValues emission = emissions(scene_, discretization_, surface),
                        reflectance = reflectances(scene_, discretization_, surface);
    for (const std::uint32_t element : elementsOf(discretization_.grids[s])) {
      const double area = discretization_.elements[element].area;
      glm::dvec3& value = light_.received[element];
      value = (emission.of(element) * area + reflectance.of(element) * value) / area;
    }
  });
  return std::move(light_.received);
}

/// The outgoing flux of a patch's elements minus what the patch has shot.
glm::dvec3 ShootingState::unshotOf(std::uint32_t number) const {
  const Patch& patch = patches_.list[number];
  const SurfaceValues emission = emissions(scene_, discretization_, patch.surface),
                      reflectance = reflectances(scene_, discretization_, patch.surface);
  KahanSum sum;
  sum.add(-light_.shot[number]);
  for (const std::uint32_t element : patch.elements)
    sum.add(emission.of(element) * discretization_.elements[element].area +
            reflectance.of(element) * light_.received[element]);
  return sum.value();
}

std::vector<glm::dvec3> ShootingState::unshotByPatches() const {
  assert(light_.shot.size() == patches_.list.size());
  assert(light_.received.size() == discretization_.elements.size());
  std::vector<glm::dvec3> unshot(light_.shot.size());
  raster::parallelFor(unshot.size(),
                      [&](std::size_t patch) { unshot[patch] = unshotOf(static_cast<std::uint32_t>(patch)); });
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
    unshot_.clear(changed);
    unshot_.add(changed, unshotOf(changed));
    blocks.push_back(changed / UnshotTree::patchesInBlock);
  };
  makeAnew(number);
  for (std::uint32_t patch = firstNew; patch < end; ++patch) makeAnew(patch);
  unshot_.update(blocks);
}

}  // namespace hemitex::radiosity
