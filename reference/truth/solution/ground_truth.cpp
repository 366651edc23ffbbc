#include "reference/truth/solution/ground_truth.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::reference {
namespace {

constexpr double spreadEvenly = 0.25;
constexpr int fewestSamples = 64;
constexpr int coarseBounces = 4;

void requireFewElements(const radiosity::Discretization& discretization) {
  const std::size_t count = discretization.elements.size();
  if (count > maxTrueElements)
    throw raster::InputError("the scene has " + std::to_string(count) + " elements, and the truth is found for " +
                                 std::to_string(maxTrueElements) + " at most",
                             "use fewer texels");
}

/// The flux that arrives at each element, from the flux that leaves each.
std::vector<glm::dvec3> arriving(const FormFactorMatrix& matrix, std::span<const glm::dvec3> flux) {
  std::vector<glm::dvec3> result(matrix.size, glm::dvec3(0));
  for (std::size_t from = 0; from < matrix.size; ++from)
    for (std::size_t to = 0; to < matrix.size; ++to) result[to] += matrix.factors[from * matrix.size + to] * flux[from];
  return result;
}

/// The flux that leaves each element after some bounces, bands summed.
std::vector<double> roughFlux(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                              const FormFactorMatrix& matrix) {
  std::vector<glm::dvec3> emitted;
  for (std::uint32_t e = 0; e < matrix.size; ++e)
    emitted.push_back(discretization.elements[e].area * emission(scene, discretization, e));
  std::vector<glm::dvec3> flux = emitted;
  for (int bounce = 0; bounce < coarseBounces; ++bounce) {
    flux = arriving(matrix, flux);
    for (std::uint32_t e = 0; e < matrix.size; ++e)
      flux[e] = emitted[e] + reflectance(scene, discretization, e) * flux[e];
  }
  std::vector<double> sums;
  for (const glm::dvec3& value : flux) sums.push_back(radiosity::bandSum(value));
  return sums;
}

/// The number of rays of each element; the mean is `average`.
std::vector<int> spreadSamples(const std::vector<double>& flux, int average) {
  const double mean = std::accumulate(flux.begin(), flux.end(), 0.0) / static_cast<double>(flux.size());
  std::vector<int> samples;
  for (const double value : flux) {
    const double share = mean > 0 ? value / mean : 1;
    samples.push_back(std::max(fewestSamples, static_cast<int>(average * (spreadEvenly + (1 - spreadEvenly) * share))));
  }
  return samples;
}

/// The effect of the spread of the form factors on light that is reflected once.
RadiosityError expectedError(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                             const TrueRadiosity& truth) {
  std::vector<glm::dvec3> flux;
  for (std::size_t e = 0; e < truth.radiosity.size(); ++e)
    flux.push_back(discretization.elements[e].area * truth.radiosity[e]);
  std::vector<glm::dvec3> moved = arriving(truth.spread, flux);
  for (std::uint32_t e = 0; e < moved.size(); ++e)
    moved[e] = truth.radiosity[e] + reflectance(scene, discretization, e) * moved[e] / discretization.elements[e].area;
  return errorOf(discretization, moved, truth.radiosity);
}

/// The form factors from each element to each element, averaged over the shooting element, over the hemisphere.
/// `samples` holds the number of rays of each element (see Sampling::samples); each element has its own seed.
FormFactorMatrix measuredMatrix(const RayFormFactors& rays, const radiosity::Discretization& discretization,
                                std::span<const int> samples, std::uint32_t seed) {
  const Receivers receivers = everyElement(discretization);
  FormFactorMatrix matrix{receivers.count, std::vector<double>(std::size_t{receivers.count} * receivers.count)};
  raster::parallelFor(receivers.count, [&](std::size_t from) {
    const auto element = static_cast<std::uint32_t>(from);
    const RaySource raySource = areaRaySource(rays.pieces(), std::vector{element});
    const Sampling sampling{samples[from], seed * receivers.count + element};
    const MeasuredRow row = rays.overHemisphere(raySource, receivers, sampling);
    for (std::size_t to = 0; to < receivers.count; ++to)
      matrix.factors[from * receivers.count + to] = row.receivers[to].value;
  });
  return matrix;
}

}  // namespace

TrueRadiosity trueRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                            const Sampling& sampling) {
  requireFewElements(discretization);
  const RayFormFactors rays(scene, discretization);
  const auto matrixOf = [&](std::span<const int> samples, std::uint32_t number) {
    return measuredMatrix(rays, discretization, samples, 3 * sampling.seed + number);
  };
  const std::vector<int> few(discretization.elements.size(), fewestSamples);
  const std::vector<int> samples =
      spreadSamples(roughFlux(scene, discretization, matrixOf(few, 0)), sampling.samples / 2);
  TrueRadiosity truth{matrixOf(samples, 1), matrixOf(samples, 2), {}, {}};
  for (std::size_t i = 0; i < truth.matrix.factors.size(); ++i) {
    const double one = truth.matrix.factors[i], other = truth.spread.factors[i];
    truth.matrix.factors[i] = (one + other) / 2;
    truth.spread.factors[i] = (one - other) / 2;
  }
  truth.radiosity = algebraicRadiosity(scene, discretization, truth.matrix);
  truth.error = expectedError(scene, discretization, truth);
  return truth;
}

}  // namespace hemitex::reference
