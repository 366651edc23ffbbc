#include "radiosity/refinement.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <span>
#include <utility>

#include "raster/parallel.h"

namespace hemitex::radiosity {
namespace {

ShotLight nothingShot(const Discretization& discretization) {
  return {std::vector<glm::dvec3>(discretization.patches.size()),
          std::vector<glm::dvec3>(discretization.elements.size())};
}

/// Behind the last element of a surface.
std::uint32_t endOf(const Grid& grid) { return grid.firstElement + grid.elementCount; }

/// Calls body(element) for the elements of a surface, in ascending order.
template <typename Body>
void forEachElement(const Grid& grid, const Body& body) {
  for (std::uint32_t e = grid.firstElement; e < endOf(grid); ++e) body(e);
}

/// What the elements of each patch emit.
std::vector<glm::dvec3> emittedByPatches(const Scene& scene, const Discretization& discretization) {
  std::vector<glm::dvec3> emitted(discretization.patches.size());
  raster::parallelFor(emitted.size(), [&](std::size_t p) {
    const Patch& patch = discretization.patches[p];
    const SurfaceValues emission = emissions(scene, discretization, patch.surface);
    if (emission.areZero()) return;
    FluxSum sum;
    for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
      const std::uint32_t element = discretization.patchElements[patch.firstElement + i];
      sum.add(emission.of(element) * discretization.elements[element].area);
    }
    emitted[p] = sum.value();
  });
  return emitted;
}

/// Entries [first, end) of a row.
struct Part {
  std::size_t first = 0, end = 0;
};

/// Parts of a row for a thread each: some thousand entries, and on to the end of a surface; elements ascend surface by
/// surface. They depend on the row alone, and so does the order of sums.
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

/// Elements that a row names so far ahead are fetched while others receive: they lie far apart, and memory is slow.
constexpr std::size_t fetchedAhead = 32;

/// What a shot does to entries of one surface: its elements receive, and what they reflect is unshot in their patches,
/// whose blocks are appended.
void receive(const Part& some, std::uint32_t surface, const glm::dvec3& shot, const FormFactorRow& row,
             const Scene& scene, const Discretization& discretization, std::vector<glm::dvec3>& received,
             UnshotFlux& unshot, std::vector<std::uint32_t>& blocks) {
  const SurfaceValues reflectance = reflectances(scene, discretization, surface);
  // As spans, which no call in the loop can change.
  const std::span elements(row.elements), patchOf(discretization.patchOf);
  const std::span shares(row.shares);
  const std::span light(received);
  std::uint32_t lastBlock = std::numeric_limits<std::uint32_t>::max();
  for (std::size_t i = some.first; i < some.end; ++i) {
    if (i + fetchedAhead < some.end) __builtin_prefetch(&light[elements[i + fetchedAhead]], 1);
    const std::uint32_t element = elements[i], patch = patchOf[element];
    const glm::dvec3 arriving = shot * formFactor(shares[i]);
    light[element] += arriving;
    unshot.add(patch, arriving * reflectance.of(element));
    const std::uint32_t block = patch / UnshotFlux::patchesInBlock;
    if (block != lastBlock) blocks.push_back(lastBlock = block);
  }
}

/// The same to all entries of a part, surface by surface.
void receive(const Part& part, const glm::dvec3& shot, const FormFactorRow& row, const Scene& scene,
             const Discretization& discretization, std::vector<glm::dvec3>& received, UnshotFlux& unshot,
             std::vector<std::uint32_t>& blocks) {
  for (std::size_t first = part.first, end = part.first; first < part.end; first = end) {
    const std::uint32_t surface = discretization.elements[row.elements[first]].surface;
    const auto behind = std::lower_bound(row.elements.begin() + static_cast<std::ptrdiff_t>(first),
                                         row.elements.begin() + static_cast<std::ptrdiff_t>(part.end),
                                         endOf(discretization.grids[surface]));
    end = static_cast<std::size_t>(behind - row.elements.begin());
    receive({first, end}, surface, shot, row, scene, discretization, received, unshot, blocks);
  }
}

}  // namespace

glm::dvec3 emittedFlux(const Scene& scene, const Discretization& discretization) {
  FluxSum sum;
  for (std::uint32_t s = 0; s < discretization.grids.size(); ++s) {
    const SurfaceValues emission = emissions(scene, discretization, s);
    if (emission.areZero()) continue;
    forEachElement(discretization.grids[s], [&](std::uint32_t element) {
      sum.add(emission.of(element) * discretization.elements[element].area);
    });
  }
  return sum.value();
}

Refinement::Refinement(const Scene& scene, const Discretization& discretization)
    : scene_(scene),
      discretization_(discretization),
      light_(nothingShot(discretization)),
      unshot_(emittedByPatches(scene, discretization)),
      emitted_(emittedFlux(scene, discretization)) {
  light_.lastEmitted = bandSum(emitted_);
}

Refinement::Refinement(const Scene& scene, const Discretization& discretization, ShotLight light)
    : scene_(scene),
      discretization_(discretization),
      light_(std::move(light)),
      unshot_(unshotByPatches()),
      emitted_(emittedFlux(scene, discretization)) {
  if (bandSum(emitted_) > 0) light_.lastEmitted = bandSum(emitted_);
  lost_.add(light_.lost);
  lostToBacks_.add(light_.lostToBacks);
}

std::size_t Refinement::shoot(std::uint32_t patch, const FormFactorRow& row) {
  const glm::dvec3 shot = unshot_.flux()[patch];
  light_.shot[patch] += shot;
  unshot_.clear(patch);
  const std::vector<Part> parts = partsOf(row, discretization_);
  std::vector<std::vector<std::uint32_t>> received(parts.size());  // blocks of patches, by each part
  // Patches belong to surfaces, so that no two threads change the same one.
  raster::parallelFor(parts.size(), [&](std::size_t i) {
    receive(parts[i], shot, row, scene_, discretization_, light_.received, unshot_, received[i]);
  });
  std::vector<std::uint32_t> blocks{patch / UnshotFlux::patchesInBlock};
  for (const std::vector<std::uint32_t>& ofPart : received) blocks.insert(blocks.end(), ofPart.begin(), ofPart.end());
  lost_.add(shot * formFactor(row.background + row.back));
  lostToBacks_.add(shot * formFactor(row.back));
  light_.lost = lost_.value();
  light_.lostToBacks = lostToBacks_.value();
  return row.elements.size() + unshot_.update(blocks);
}

Energy Refinement::energy() const {
  FluxSum unshot;
  for (const glm::dvec3& flux : unshot_.flux()) unshot.add(flux);
  return {emitted_, absorbed(), unshot.value(), lost_.value(), lostToBacks_.value()};
}

/// What the elements received and do not send on. Few are summed plainly, which is four times as fast and costs no more
/// than a digit.
glm::dvec3 Refinement::absorbed() const {
  constexpr std::uint32_t summedPlainly = 64;
  std::vector<glm::dvec3> ofSurfaces(discretization_.grids.size());
  raster::parallelFor(ofSurfaces.size(), [&](std::size_t s) {
    const SurfaceValues reflectance = reflectances(scene_, discretization_, static_cast<std::uint32_t>(s));
    const Grid& grid = discretization_.grids[s];
    FluxSum sum;
    for (std::uint32_t first = grid.firstElement; first < endOf(grid); first += summedPlainly) {
      glm::dvec3 some(0);
      for (std::uint32_t e = first; e < std::min(first + summedPlainly, endOf(grid)); ++e)
        some += light_.received[e] - light_.received[e] * reflectance.of(e);
      sum.add(some);
    }
    ofSurfaces[s] = sum.value();
  });
  FluxSum sum;
  for (const glm::dvec3& ofSurface : ofSurfaces) sum.add(ofSurface);
  return sum.value();
}

double Refinement::residual() const {
  return light_.lastEmitted > 0 ? (bandSum(unshot_.sizes()) + light_.astray) / light_.lastEmitted : 0;
}

std::vector<glm::dvec3> Refinement::radiosity() const& {
  std::vector<glm::dvec3> result = light_.received;
  makeRadiosity(result);
  return result;
}

std::vector<glm::dvec3> Refinement::radiosity() && {
  makeRadiosity(light_.received);
  return std::move(light_.received);
}

std::size_t Refinement::bytes() const {
  return (light_.shot.capacity() + light_.received.capacity()) * sizeof(glm::dvec3) + unshot_.bytes();
}

/// From what elements received to their radiosity: what they send out over their area.
void Refinement::makeRadiosity(std::vector<glm::dvec3>& received) const {
  raster::parallelFor(discretization_.grids.size(), [&](std::size_t s) {
    const auto surface = static_cast<std::uint32_t>(s);
    const SurfaceValues emission = emissions(scene_, discretization_, surface),
                        reflectance = reflectances(scene_, discretization_, surface);
    forEachElement(discretization_.grids[s], [&](std::uint32_t element) {
      const double area = discretization_.elements[element].area;
      received[element] = (emission.of(element) * area + reflectance.of(element) * received[element]) / area;
    });
  });
}

/// What the elements of each patch send out and the patch has not shot yet.
std::vector<glm::dvec3> Refinement::unshotByPatches() const {
  assert(light_.shot.size() == discretization_.patches.size());
  assert(light_.received.size() == discretization_.elements.size());
  std::vector<glm::dvec3> unshot(light_.shot.size());
  raster::parallelFor(unshot.size(), [&](std::size_t p) {
    const Patch& patch = discretization_.patches[p];
    const SurfaceValues emission = emissions(scene_, discretization_, patch.surface),
                        reflectance = reflectances(scene_, discretization_, patch.surface);
    FluxSum sum;
    sum.add(-light_.shot[p]);
    for (std::uint32_t i = 0; i < patch.elementCount; ++i) {
      const std::uint32_t element = discretization_.patchElements[patch.firstElement + i];
      sum.add(emission.of(element) * discretization_.elements[element].area +
              reflectance.of(element) * light_.received[element]);
    }
    unshot[p] = sum.value();
  });
  return unshot;
}

}  // namespace hemitex::radiosity
