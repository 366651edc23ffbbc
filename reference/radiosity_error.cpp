#include "reference/radiosity_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hemitex::reference {
namespace {

double bandSum(const glm::dvec3& value) { return value.x + value.y + value.z; }

double difference(const glm::dvec3& a, const glm::dvec3& b) { return bandSum(glm::abs(a - b)); }

/// Of the elements [first, first + count).
RadiosityError errorOfRange(const radiosity::Discretization& discretization, std::span<const glm::dvec3> found,
                            std::span<const glm::dvec3> truth, std::size_t first, std::size_t count) {
  double area = 0, flux = 0, missed = 0, squares = 0, largest = 0;
  for (std::size_t e = first; e < first + count; ++e) {
    const double elementArea = discretization.elements[e].area;
    const double error = difference(found[e], truth[e]);
    area += elementArea;
    flux += elementArea * bandSum(truth[e]);
    missed += elementArea * error;
    squares += elementArea * error * error;
    largest = std::max(largest, error);
  }
  if (largest == 0) return {};
  const double mean = flux / area;
  return {missed / flux, std::sqrt(squares / area) / mean, largest / mean};
}

}  // namespace

RadiosityError errorOf(const radiosity::Discretization& discretization, std::span<const glm::dvec3> found,
                       std::span<const glm::dvec3> truth) {
  assert(found.size() == discretization.elements.size() && truth.size() == found.size());
  return errorOfRange(discretization, found, truth, 0, found.size());
}

std::vector<RadiosityError> errorsBySurface(const radiosity::Discretization& discretization,
                                            std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth) {
  std::vector<RadiosityError> errors;
  for (const radiosity::Grid& grid : discretization.grids)
    errors.push_back(errorOfRange(discretization, found, truth, grid.firstElement, grid.elementCount));
  return errors;
}

std::vector<double> errorsByElement(std::span<const glm::dvec3> found, std::span<const glm::dvec3> truth) {
  std::vector<double> errors;
  for (std::size_t e = 0; e < found.size(); ++e) {
    const double error = difference(found[e], truth[e]);
    errors.push_back(error == 0 ? 0 : error / bandSum(truth[e]));
  }
  return errors;
}

}  // namespace hemitex::reference
