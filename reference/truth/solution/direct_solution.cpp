#include "reference/truth/solution/direct_solution.h"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>

#include "reference/truth/solution/form_factor_matrix.h"

namespace hemitex::reference {
namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// One band of a vector of colours.
Eigen::VectorXd bandOf(std::span<const glm::dvec3> values, int band) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(values.size()));
  for (std::size_t i = 0; i < values.size(); ++i) result[static_cast<Eigen::Index>(i)] = values[i][band];
  return result;
}

/// The flux of one band, and the residual of its equations.
struct Band {
  Eigen::VectorXd flux;
  double missing;
};

Band solveBand(const Eigen::Map<const RowMajor>& factors, const Eigen::VectorXd& emitted,
               const Eigen::VectorXd& reflectance) {
  const Eigen::Index size = emitted.size();
  const Eigen::MatrixXd equations =
      Eigen::MatrixXd::Identity(size, size) - reflectance.asDiagonal() * factors.transpose();
  const Eigen::PartialPivLU<Eigen::MatrixXd> decomposition(equations);
  Band band{decomposition.solve(emitted), 0};
  // Two steps of iterative refinement remove the rounding error of the decomposition.
  for (int step = 0; step < 2; ++step) band.flux += decomposition.solve(emitted - equations * band.flux);
  band.missing = (emitted - equations * band.flux).lpNorm<1>();
  return band;
}

}  // namespace

DirectSolution solveDirectly(const FormFactorMatrix& matrix, std::span<const glm::dvec3> emitted,
                             std::span<const glm::dvec3> reflectance) {
  assert(matrix.factors.size() == matrix.size * matrix.size);
  assert(emitted.size() == matrix.size && reflectance.size() == matrix.size);
  const auto size = static_cast<Eigen::Index>(matrix.size);
  const Eigen::Map<const RowMajor> factors(matrix.factors.data(), size, size);
  DirectSolution solution{std::vector<glm::dvec3>(matrix.size), 0};
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd source = bandOf(emitted, k);
    const Band band = solveBand(factors, source, bandOf(reflectance, k));
    for (std::size_t e = 0; e < matrix.size; ++e) solution.flux[e][k] = band.flux[static_cast<Eigen::Index>(e)];
    if (band.missing > 0) solution.residual = std::max(solution.residual, band.missing / band.flux.lpNorm<1>());
  }
  return solution;
}

std::vector<glm::dvec3> algebraicRadiosity(const radiosity::Scene& scene,
                                           const radiosity::Discretization& discretization,
                                           const FormFactorMatrix& matrix) {
  const auto& elements = discretization.elements;
  std::vector<glm::dvec3> emitted, reflectances;
  for (std::uint32_t e = 0; e < elements.size(); ++e) {
    emitted.push_back(emission(scene, discretization, e) * elements[e].area);
    reflectances.push_back(reflectance(scene, discretization, e));
  }
  std::vector<glm::dvec3> radiosity = solveDirectly(matrix, emitted, reflectances).flux;
  for (std::size_t e = 0; e < radiosity.size(); ++e) radiosity[e] /= elements[e].area;
  return radiosity;
}

}  // namespace hemitex::reference
