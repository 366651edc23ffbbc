#include "radiosity/solver/sensitivity.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {
namespace {

using Colours = std::vector<glm::dvec3>;

/// The rows of all patches: row p has the entries [first[p], first[p + 1]).
struct PatchMatrix {
  std::vector<std::size_t> first{0};
  std::vector<std::uint32_t> element;
  std::vector<double> factor;
};

PatchMatrix rowsOf(const SolveInput& input, const RowProgress& progress) {
  PatchMatrix matrix;
  const std::vector<Patch>& patches = input.patches.list;
  for (std::size_t p = 0; p < patches.size(); ++p) {
    if (progress) progress(p, patches.size());
    const FormFactorRow row = input.rowOf(patches[p]);
    for (std::size_t k = 0; k < row.elements.size(); ++k) {
      matrix.element.push_back(row.elements[k]);
      matrix.factor.push_back(formFactor(row.shares[k]));
    }
    matrix.first.push_back(matrix.element.size());
  }
  return matrix;
}

double sizeOf(const Colours& values) {
  double size = 0;
  for (const glm::dvec3& value : values)
    for (int band = 0; band < 3; ++band) size = std::max(size, std::abs(value[band]));
  return size;
}

/// Iterates x = step(x) from x until it changes by less than 1e-14 of its size. Each step multiplies the error by the
/// largest reflectance or less; 0.9999 needs 320,000 steps.
Colours fixedPoint(Colours x, const std::function<Colours(const Colours&)>& step) {
  constexpr double tolerance = 1e-14;
  constexpr int maxSteps = 1'000'000;
  for (int n = 0; n < maxSteps; ++n) {
    Colours next = step(x);
    double change = 0;
    for (std::size_t i = 0; i < x.size(); ++i) {
      const glm::dvec3 difference = glm::abs(next[i] - x[i]);
      change = std::max({change, difference.x, difference.y, difference.z});
    }
    x = std::move(next);
    if (!(change > tolerance * sizeOf(x))) break;
  }
  return x;
}

class Equations {
 public:
  Equations(const SolveInput& input, const RowProgress& progress)
      : input_(input), progress_(progress), matrix_(rowsOf(input, progress)), patchOf_(input.patches.ofElement) {
    const std::size_t elements = input.discretization.elements.size();
    for (std::uint32_t e = 0; e < elements; ++e) {
      area_.push_back(input.discretization.elements[e].area);
      reflectance_.push_back(reflectance(input.scene, input.discretization, e));
      emitted_.push_back(emission(input.scene, input.discretization, e) * area_.back());
    }
    outside_.resize(elements);
    const BandTable& received = input.outside.received;
    for (std::size_t e = 0; e < received.size(); ++e) outside_[e] = {received[e][0], received[e][1], received[e][2]};
  }

  /// The flux that each element receives, from outside and from others.
  Colours received() const {
    return fixedPoint(outside_, [this](const Colours& received) {
      tell();
      Colours shot(input_.patches.list.size(), glm::dvec3(0.0));
      for (std::size_t e = 0; e < area_.size(); ++e) shot[patchOf_[e]] += emitted_[e] + reflectance_[e] * received[e];
      Colours next = outside_;
      for (std::size_t p = 0; p < shot.size(); ++p)
        for (std::size_t k = matrix_.first[p]; k < matrix_.first[p + 1]; ++k)
          next[matrix_.element[k]] += matrix_.factor[k] * shot[p];
      return next;
    });
  }

  /// The importance of each element for the weights.
  Colours importance(std::span<const glm::dvec3> weights) const {
    const auto ofElement = [&](const Colours& ofPatch, std::size_t e) {
      return weights[e] / area_[e] + ofPatch[patchOf_[e]];
    };
    const Colours ofPatch = fixedPoint(Colours(input_.patches.list.size(), glm::dvec3(0.0)), [&](const Colours& last) {
      tell();
      Colours next(last.size(), glm::dvec3(0.0));
      for (std::size_t p = 0; p < next.size(); ++p)
        for (std::size_t k = matrix_.first[p]; k < matrix_.first[p + 1]; ++k)
          next[p] += matrix_.factor[k] * reflectance_[matrix_.element[k]] * ofElement(last, matrix_.element[k]);
      return next;
    });
    Colours values;
    for (std::size_t e = 0; e < area_.size(); ++e) values.push_back(ofElement(ofPatch, e));
    return values;
  }

  /// `flux` is what elements receive.
  Sensitivity sensitivity(const Colours& flux, std::span<const glm::dvec3> weights) const {
    const Colours value = importance(weights);
    Sensitivity result;
    for (std::size_t e = 0; e < area_.size(); ++e) {
      result.target += value[e] * (emitted_[e] + reflectance_[e] * outside_[e]);
      result.byEmission.push_back(area_[e] * value[e]);
      result.byReflectance.push_back(flux[e] * value[e]);
      result.radiosity.push_back((emitted_[e] + reflectance_[e] * flux[e]) / area_[e]);
    }
    return result;
  }

 private:
  void tell() const {
    if (progress_) progress_(input_.patches.list.size(), input_.patches.list.size());
  }

  const SolveInput& input_;
  const RowProgress& progress_;
  PatchMatrix matrix_;
  const std::vector<std::uint32_t>& patchOf_;
  std::vector<double> area_;
  Colours reflectance_, emitted_, outside_;
};

}  // namespace

std::vector<Sensitivity> sensitivities(const SolveInput& input, std::span<const std::vector<glm::dvec3>> targets,
                                       const RowProgress& progress) {
  assert(input.scene.wavelengths.empty());
  const Equations equations(input, progress);
  const Colours flux = equations.received();
  std::vector<Sensitivity> results;
  for (const std::vector<glm::dvec3>& weights : targets) {
    assert(weights.size() == input.discretization.elements.size());
    results.push_back(equations.sensitivity(flux, weights));
  }
  return results;
}

}  // namespace hemitex::radiosity
