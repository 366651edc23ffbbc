#include "reference/truth/solution/radiosity_error.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace hemitex::reference {
namespace {

/// The element of a grid at the centre of a texel of another grid over the same chart.
std::uint32_t elementAtCentre(const radiosity::Grid& grid, const radiosity::Grid& other, std::uint32_t texel) {
  const auto along = [](std::uint32_t index, int count, int otherCount) {
    return (2 * index + 1) * static_cast<std::uint32_t>(count) / (2 * static_cast<std::uint32_t>(otherCount));
  };
  const auto otherColumns = static_cast<std::uint32_t>(other.columns);
  const std::uint32_t column = along(texel % otherColumns, grid.columns, other.columns);
  const std::uint32_t row = along(texel / otherColumns, grid.rows, other.rows);
  return grid.elementOfTexel[row * static_cast<std::uint32_t>(grid.columns) + column];
}

}  // namespace

std::vector<std::uint32_t> elementsUnder(const radiosity::Discretization& coarse,
                                         const radiosity::Discretization& fine) {
  assert(coarse.grids.size() == fine.grids.size());
  std::vector<std::uint32_t> elements;
  for (const radiosity::Element& element : fine.elements)
    elements.push_back(elementAtCentre(coarse.grids[element.surface], fine.grids[element.surface], element.texel));
  return elements;
}

std::vector<glm::dvec3> onOtherGrids(const radiosity::Discretization& coarse, std::span<const glm::dvec3> radiosity,
                                     const radiosity::Discretization& fine) {
  assert(radiosity.size() == coarse.elements.size());
  std::vector<glm::dvec3> result;
  for (const std::uint32_t element : elementsUnder(coarse, fine)) result.push_back(radiosity[element]);
  return result;
}

RadiosityError errorOf(const radiosity::Discretization& discretization, std::span<const glm::dvec3> found,
                       std::span<const glm::dvec3> truth) {
  assert(found.size() == discretization.elements.size() && truth.size() == found.size());
  double area = 0, flux = 0, missed = 0, squares = 0, largest = 0;
  for (std::size_t e = 0; e < found.size(); ++e) {
    const double elementArea = discretization.elements[e].area;
    const double error = radiosity::bandSum(glm::abs(found[e] - truth[e]));
    area += elementArea;
    flux += elementArea * radiosity::bandSum(truth[e]);
    missed += elementArea * error;
    squares += elementArea * error * error;
    largest = std::max(largest, error);
  }
  if (largest == 0) return {};
  const double mean = flux / area;
  return {missed / flux, std::sqrt(squares / area) / mean, largest / mean};
}

}  // namespace hemitex::reference
