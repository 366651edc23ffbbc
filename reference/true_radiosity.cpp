#include "reference/true_radiosity.h"

#include <string>

#include "raster/input_error.h"
#include "raster/parallel.h"

namespace hemitex::reference {
namespace {

void requireFewElements(const radiosity::Discretization& discretization) {
  const std::size_t count = discretization.elements.size();
  if (count > mostTrueElements)
    throw raster::InputError("the scene has " + std::to_string(count) + " elements, and the truth is found for " +
                                 std::to_string(mostTrueElements) + " at most",
                             "use fewer texels (--texels)");
}

}  // namespace

FormFactorMatrix measuredMatrix(const RayFormFactors& rays, const radiosity::Discretization& discretization,
                                const Sampling& sampling) {
  const Receivers receivers = everyElement(discretization);
  FormFactorMatrix matrix{receivers.count, std::vector<double>(std::size_t{receivers.count} * receivers.count)};
  raster::parallelFor(receivers.count, [&](std::size_t from) {
    const auto element = static_cast<std::uint32_t>(from);
    const Shooter shooter = areaShooter(rays.pieces(), std::vector{element});
    const std::uint32_t seed = sampling.seed * receivers.count + element;
    const MeasuredRow row = rays.overHemisphere(shooter, receivers, {sampling.samples, seed});
    for (std::size_t to = 0; to < receivers.count; ++to)
      matrix.factors[from * receivers.count + to] = row.receivers[to].value;
  });
  return matrix;
}

TrueRadiosity trueRadiosity(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                            const Sampling& sampling) {
  requireFewElements(discretization);
  const RayFormFactors rays(scene, discretization);
  const auto half = [&](std::uint32_t number) {
    return measuredMatrix(rays, discretization, {sampling.samples / 2, 2 * sampling.seed + number});
  };
  TrueRadiosity truth{half(0), {}, {}};
  const std::vector<glm::dvec3> first = algebraicRadiosity(scene, discretization, truth.matrix);
  const FormFactorMatrix other = half(1);
  const std::vector<glm::dvec3> second = algebraicRadiosity(scene, discretization, other);
  for (std::size_t i = 0; i < other.factors.size(); ++i)
    truth.matrix.factors[i] = (truth.matrix.factors[i] + other.factors[i]) / 2;
  for (std::size_t e = 0; e < first.size(); ++e) truth.radiosity.push_back((first[e] + second[e]) / 2.0);
  truth.error = errorOf(discretization, first, truth.radiosity);
  return truth;
}

}  // namespace hemitex::reference
