#include "radiosity/bands/element_table.h"

#include <catch2/catch.hpp>
#include <variant>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// A solution with a different radiosity of each element in each band.
Solution solutionOf(std::size_t elements) {
  Solution solution;
  for (std::size_t e = 0; e < elements; ++e) solution.radiosity.push_back(double(e) + glm::dvec3(0, 0.25, 0.5));
  return solution;
}

}  // namespace

TEST_CASE("elementTable has a row per element: its texel, centre, normal, area and radiosity", "[elements]") {
  const Scene scene = tests::sceneOf({tests::quad("side", {glm::dvec3(0, 0, 0), {0, 4, 0}, {0, 4, 4}, {0, 0, 4}}),
                                      tests::quad("floor", {glm::dvec3(0, 0, 0), {4, 0, 0}, {4, 8, 0}, {0, 8, 0}})});
  const Discretization discretization = discretize(scene, {.texels = 2});
  const Solution solution = solutionOf(discretization.elements.size());
  const Table table = elementTable(scene, discretization, solution);
  CHECK(table.columns == std::vector<std::string>{"surface", "column", "row", "x", "y", "z", "nx", "ny", "nz", "area",
                                                  "b_r", "b_g", "b_b"});
  REQUIRE(table.size == discretization.elements.size());
  const std::uint32_t second = discretization.grids[1].firstElement;
  const std::vector<Cell> side{"side", std::int64_t{1}, std::int64_t{0}, 0., 3., 1., 1., 0., 0., 4., 1., 1.25, 1.5};
  CHECK(table.row(1) == side);
  const std::vector<Cell> floor = table.row(second);
  CHECK(floor[0] == Cell("floor"));
  CHECK(floor[10] == Cell(double(second)));
}

TEST_CASE("elementTable has a column per band behind the colour", "[elements]") {
  Scene scene = tests::closedCube(glm::dvec3(0.5), glm::dvec3(0));
  scene.wavelengths = {600, 500, 452.5, 400};
  const Discretization discretization = discretize(scene, {.texels = 1});
  const std::size_t elements = discretization.elements.size();
  Solution colours = solutionOf(elements);
  colours.radiosityInBands = BandTable(elements, 4);
  for (std::size_t i = 0; i < 4 * elements; ++i) colours.radiosityInBands.values[i] = static_cast<double>(i);
  const Table table = elementTable(scene, discretization, colours);
  REQUIRE(table.columns.size() == 17);
  CHECK(table.columns[14] == "b_452.5");
  for (std::size_t e = 0; e < elements; ++e) {
    const std::vector<Cell> row = table.row(e);
    REQUIRE(row.size() == 17);
    CHECK(row[12] == Cell(colours.radiosity[e].b));
    for (std::size_t band = 0; band < 4; ++band) CHECK(row[13 + band] == Cell(colours.radiosityInBands[e][3 - band]));
  }
}
