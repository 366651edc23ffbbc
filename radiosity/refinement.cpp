#include "radiosity/refinement.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace hemitex::radiosity {
namespace {

ShotLight nothingShot(const Discretization& discretization) {
  return {std::vector<glm::dvec3>(discretization.patches.size()),
          std::vector<glm::dvec3>(discretization.elements.size())};
}

double size(const glm::dvec3& flux) { return bandSum(glm::abs(flux)); }

}  // namespace

Refinement::Refinement(const Scene& scene, const Discretization& discretization)
    : Refinement(scene, discretization, nothingShot(discretization)) {}

Refinement::Refinement(const Scene& scene, const Discretization& discretization, ShotLight light)
    : scene_(scene),
      discretization_(discretization),
      light_(std::move(light)),
      flux_(discretization.elements.size()),
      unshot_(discretization.elements.size()),
      patchUnshot_(discretization.patches.size()) {
  assert(light_.shot.size() == patchUnshot_.size() && light_.received.size() == flux_.size());
  for (std::uint32_t e = 0; e < flux_.size(); ++e) {
    const glm::dvec3 emitted = emission(scene, discretization, e) * discretization.elements[e].area;
    const glm::dvec3 reflected = reflectance(scene, discretization, e) * light_.received[e];
    send(e, emitted + reflected);
    emitted_.add(emitted);
    absorbed_.add(light_.received[e] - reflected);
  }
  // The flux that a patch shot is taken from its first element: only the patch's sum is ever shot.
  for (std::size_t p = 0; p < patchUnshot_.size(); ++p) {
    unshot_[discretization.patchElements[discretization.patches[p].firstElement]] -= light_.shot[p];
    patchUnshot_[p] -= light_.shot[p];
  }
  if (const double emitted = bandSum(emitted_.value()); emitted > 0) light_.lastEmitted = emitted;
  lost_.add(light_.lost);
  lostToBacks_.add(light_.lostToBacks);
}

std::uint32_t Refinement::brightestPatch() const {
  const auto brightest = std::max_element(patchUnshot_.begin(), patchUnshot_.end(),
                                          [](const glm::dvec3& a, const glm::dvec3& b) { return size(a) < size(b); });
  return static_cast<std::uint32_t>(brightest - patchUnshot_.begin());
}

void Refinement::shoot(std::uint32_t patch, const FormFactorRow& row) {
  const glm::dvec3 shot = takeUnshot(patch);
  light_.shot[patch] += shot;
  for (std::size_t i = 0; i < row.elements.size(); ++i) {
    const std::uint32_t element = row.elements[i];
    const glm::dvec3 arriving = shot * formFactor(row.shares[i]);
    const glm::dvec3 reflected = arriving * reflectance(scene_, discretization_, element);
    light_.received[element] += arriving;
    send(element, reflected);
    absorbed_.add(arriving - reflected);
  }
  lost_.add(shot * formFactor(row.background + row.back));
  lostToBacks_.add(shot * formFactor(row.back));
  light_.lost = lost_.value();
  light_.lostToBacks = lostToBacks_.value();
}

Energy Refinement::energy() const {
  FluxSum unshot;
  for (const glm::dvec3& flux : patchUnshot_) unshot.add(flux);
  return {emitted_.value(), absorbed_.value(), unshot.value(), lost_.value(), lostToBacks_.value()};
}

double Refinement::residual() const {
  FluxSum unshot;
  for (const glm::dvec3& flux : patchUnshot_) unshot.add(glm::abs(flux));
  return light_.lastEmitted > 0 ? (bandSum(unshot.value()) + light_.astray) / light_.lastEmitted : 0;
}

std::vector<glm::dvec3> Refinement::radiosity() const {
  std::vector<glm::dvec3> result(flux_.size());
  for (std::size_t e = 0; e < result.size(); ++e) result[e] = flux_[e] / discretization_.elements[e].area;
  return result;
}

void Refinement::send(std::uint32_t element, const glm::dvec3& flux) {
  flux_[element] += flux;
  unshot_[element] += flux;
  patchUnshot_[discretization_.elements[element].patch] += flux;
}

/// What the elements of a patch have not shot yet, summed afresh so that no rounding of running sums remains.
glm::dvec3 Refinement::takeUnshot(std::uint32_t patch) {
  const Patch& shooter = discretization_.patches[patch];
  FluxSum sum;
  for (std::uint32_t i = 0; i < shooter.elementCount; ++i) {
    glm::dvec3& unshot = unshot_[discretization_.patchElements[shooter.firstElement + i]];
    sum.add(unshot);
    unshot = glm::dvec3(0);
  }
  patchUnshot_[patch] = glm::dvec3(0);
  return sum.value();
}

}  // namespace hemitex::radiosity
