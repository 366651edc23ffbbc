#include "reference/truth/solution/direct_solution.h"

#include <Eigen/LU>
#include <cassert>

namespace hemitex::reference {

std::vector<glm::dvec3> solveDirectly(const FormFactorMatrix& matrix, std::span<const glm::dvec3> emitted,
                                      std::span<const glm::dvec3> reflectance) {
  using Eigen::Dynamic, Eigen::MatrixXd, Eigen::RowMajor, Eigen::VectorXd;
  using Bands = Eigen::Matrix<double, Dynamic, 3, RowMajor>;
  assert(matrix.factors.size() == matrix.size * matrix.size);
  assert(emitted.size() == matrix.size && reflectance.size() == matrix.size);
  const auto size = static_cast<Eigen::Index>(matrix.size);
  const Eigen::Map<const Eigen::Matrix<double, Dynamic, Dynamic, RowMajor>> factors(matrix.factors.data(), size, size);
  const Eigen::Map<const Bands> sources(&emitted.data()->x, size, 3), reflectances(&reflectance.data()->x, size, 3);
  std::vector<glm::dvec3> flux(matrix.size);
  Eigen::Map<Bands> fluxes(&flux.data()->x, size, 3);
  for (int band = 0; band < 3; ++band) {
    const VectorXd source = sources.col(band);
    const MatrixXd equations =
        MatrixXd::Identity(size, size) - reflectances.col(band).asDiagonal() * factors.transpose();
    const Eigen::PartialPivLU<MatrixXd> decomposition(equations);
    VectorXd found = decomposition.solve(source);
    // Two steps of iterative refinement remove the rounding error of the decomposition.
    for (int step = 0; step < 2; ++step) found += decomposition.solve(source - equations * found);
    fluxes.col(band) = found;
  }
  return flux;
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
  std::vector<glm::dvec3> radiosity = solveDirectly(matrix, emitted, reflectances);
  for (std::size_t e = 0; e < radiosity.size(); ++e) radiosity[e] /= elements[e].area;
  return radiosity;
}

}  // namespace hemitex::reference
