#include "radiosity/solver.h"

#include <algorithm>
#include <cassert>
#include <list>
#include <map>

namespace hemitex::radiosity {
namespace {

double bandSum(const glm::dvec3& flux) { return flux.x + flux.y + flux.z; }

/// A sum of fluxes to the last digit however many there are (Kahan 1965): `rest_` holds what rounding cut off so far.
class FluxSum {
 public:
  void add(const glm::dvec3& flux) {
    const glm::dvec3 term = flux - rest_;
    const glm::dvec3 sum = sum_ + term;
    rest_ = (sum - sum_) - term;
    sum_ = sum;
  }
  const glm::dvec3& value() const { return sum_; }

 private:
  glm::dvec3 sum_{0.0}, rest_{0.0};
};

/// Rows of form factors within a budget of memory; the row used longest ago goes first. The answer does not depend on
/// it: a row that was dropped is computed again, to the same bits.
class RowCache {
 public:
  RowCache(const RowSource& source, std::size_t budget) : source_(source), budget_(budget) {}

  /// Valid until the next call.
  const FormFactorRow& row(std::uint32_t patch) {
    const auto found = byPatch_.find(patch);
    if (found != byPatch_.end()) {
      recent_.splice(recent_.begin(), recent_, found->second);
      return recent_.front().row;
    }
    recent_.push_front({patch, source_(patch)});
    byPatch_[patch] = recent_.begin();
    used_ += bytes(recent_.front().row);
    while (used_ > budget_ && recent_.size() > 1) {
      used_ -= bytes(recent_.back().row);
      byPatch_.erase(recent_.back().patch);
      recent_.pop_back();
    }
    return recent_.front().row;
  }

 private:
  struct Entry {
    std::uint32_t patch;
    FormFactorRow row;
  };

  static std::size_t bytes(const FormFactorRow& row) {
    return sizeof(Entry) + row.elements.capacity() * sizeof(std::uint32_t) +
           row.shares.capacity() * sizeof(std::uint64_t);
  }

  const RowSource& source_;
  std::size_t budget_;
  std::size_t used_ = 0;
  std::list<Entry> recent_;
  std::map<std::uint32_t, std::list<Entry>::iterator> byPatch_;
};

/// The state of the refinement, in flux: radiosity times area.
class Refinement {
 public:
  Refinement(const Scene& scene, const Discretization& discretization)
      : scene_(scene),
        discretization_(discretization),
        flux_(discretization.elements.size()),
        unshot_(discretization.elements.size()),
        patchUnshot_(discretization.patches.size()) {
    for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
      const glm::dvec3 emitted = emission(scene, discretization, e) * discretization.elements[e].area;
      receive(e, emitted);
      emitted_.add(emitted);
    }
  }

  /// The patch with the most unshot flux, bands summed; the first of equals.
  std::uint32_t brightestPatch() const {
    const auto brightest =
        std::max_element(patchUnshot_.begin(), patchUnshot_.end(),
                         [](const glm::dvec3& a, const glm::dvec3& b) { return bandSum(a) < bandSum(b); });
    return static_cast<std::uint32_t>(brightest - patchUnshot_.begin());
  }

  /// Sends the unshot flux of a patch along its row of form factors.
  void shoot(std::uint32_t patch, const FormFactorRow& row) {
    const glm::dvec3 shot = takeUnshot(patch);
    for (std::size_t i = 0; i < row.elements.size(); ++i) {
      const glm::dvec3 arriving = shot * formFactor(row.shares[i]);
      const glm::dvec3 reflected = arriving * reflectance(scene_, discretization_, row.elements[i]);
      receive(row.elements[i], reflected);
      absorbed_.add(arriving - reflected);
    }
    lost_.add(shot * formFactor(row.background + row.back));
    lostToBacks_.add(shot * formFactor(row.back));
  }

  /// The account, with what is unshot summed afresh.
  Energy energy() const {
    FluxSum unshot;
    for (const glm::dvec3& flux : patchUnshot_) unshot.add(flux);
    return {emitted_.value(), absorbed_.value(), unshot.value(), lost_.value(), lostToBacks_.value()};
  }

  /// Radiosity of the elements: flux over area.
  std::vector<glm::dvec3> radiosity() const {
    std::vector<glm::dvec3> result(flux_.size());
    for (std::size_t e = 0; e < result.size(); ++e) result[e] = flux_[e] / discretization_.elements[e].area;
    return result;
  }

 private:
  void receive(std::uint32_t element, const glm::dvec3& flux) {
    flux_[element] += flux;
    unshot_[element] += flux;
    patchUnshot_[discretization_.elements[element].patch] += flux;
  }

  /// What the elements of a patch have not shot yet, summed afresh so that no rounding of running sums remains.
  glm::dvec3 takeUnshot(std::uint32_t patch) {
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

  const Scene& scene_;
  const Discretization& discretization_;
  std::vector<glm::dvec3> flux_, unshot_, patchUnshot_;
  FluxSum emitted_, absorbed_, lost_, lostToBacks_;
};

double residualOf(const Energy& energy) {
  const double emitted = bandSum(energy.emitted);
  return emitted > 0 ? bandSum(energy.unshot) / emitted : 0;
}

/// The radiosity that the unshot flux will add on average, per band, before the reflectance of who receives it:
/// spread over all surfaces and reflected for ever at the mean reflectance (Cohen et al. 1988).
glm::dvec3 ambientEstimate(const Scene& scene, const Discretization& discretization, const Energy& energy) {
  double area = 0;
  glm::dvec3 reflecting(0);
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e) {
    area += discretization.elements[e].area;
    reflecting += reflectance(scene, discretization, e) * discretization.elements[e].area;
  }
  return energy.unshot / (area - reflecting);
}

std::vector<std::string> warningsOf(const Energy& energy) {
  const double lostToBacks = bandSum(energy.lostToBacks) / bandSum(energy.emitted);
  if (!(lostToBacks > 0.01)) return {};
  const int tenths = static_cast<int>(lostToBacks * 1000 + 0.5);
  return {std::to_string(tenths / 10) + "." + std::to_string(tenths % 10) +
          " % of the emitted flux was absorbed by the backs of faces; check that faces wind counter-clockwise as seen "
          "from the lit side, or use --two-sided"};
}

}  // namespace

Solution solve(const Scene& scene, const Discretization& discretization, const RowSource& rowOf,
               const SolverSettings& settings, const Progress& progress) {
  assert(!discretization.patches.empty());
  Refinement refinement(scene, discretization);
  RowCache rows(rowOf, settings.rowCacheBytes);
  Solution solution;
  solution.energy = refinement.energy();
  solution.residual = residualOf(solution.energy);
  const auto isDone = [&] {
    return solution.residual <= settings.residual || (settings.shots && solution.shots >= *settings.shots);
  };
  while (!isDone()) {
    const std::uint32_t patch = refinement.brightestPatch();
    refinement.shoot(patch, rows.row(patch));
    ++solution.shots;
    solution.energy = refinement.energy();
    solution.residual = residualOf(solution.energy);
    if (progress) progress(solution.shots, solution.residual);
  }
  solution.radiosity = refinement.radiosity();
  solution.ambient = ambientEstimate(scene, discretization, solution.energy);
  solution.warnings = warningsOf(solution.energy);
  return solution;
}

}  // namespace hemitex::radiosity
