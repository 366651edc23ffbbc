// Error measures of rows, with numbers that can be checked by hand, and with a matrix that has a closed form on all
// grids.
#include "reference/truth/solution/row_error.h"

#include <catch2/catch.hpp>
#include <cmath>

#include "radiosity/discretization/discretize.h"
#include "reference/truth/solution/form_factor_matrix.h"
#include "tests/support/hand_scenes.h"

using namespace hemitex;
using namespace hemitex::reference;

namespace {

/// On the inside of a sphere each element sends to all others, and to itself, in proportion to area.
FormFactorMatrix asInASphere(const radiosity::Discretization& discretization) {
  const std::size_t size = discretization.elements.size();
  double area = 0;
  for (const radiosity::Element& element : discretization.elements) area += element.area;
  FormFactorMatrix matrix{size, {}};
  for (std::size_t from = 0; from < size; ++from)
    for (const radiosity::Element& element : discretization.elements) matrix.factors.push_back(element.area / area);
  return matrix;
}

}  // namespace

TEST_CASE("rowError weights rows by the flux that they carry", "[tradeoff]") {
  // Two patches that see two elements, and a third that shoots nothing, so that its row does not matter.
  const DenseRows truth{2, {0.5, 0.25, 0, 1, 0.5, 0.5}};
  const DenseRows found{2, {0.25, 0.5, 0, 0.875, 0, 0}};  // errors of 0.25, 0.25; 0, 0.125
  const RowError error = rowError(found, truth, std::vector<double>{1, 3, 0});
  CHECK(error.relativeL1 == Approx((1 * 0.5 + 3 * 0.125) / (1 * 0.75 + 3 * 1)));
  CHECK(error.rms == Approx(std::sqrt((1 * 2 * 0.0625 + 3 * 0.015625) / (2 * (1 + 3)))));
  CHECK(error.maximum == 0.25);
  CHECK(rowError(truth, truth, std::vector<double>{1, 3, 0}).relativeL1 == 0);
}

TEST_CASE("denseRows of coarse patches are sums and averages of the fine matrix", "[tradeoff]") {
  // For a sphere, sums over receiving elements are again the areas of coarse elements over the whole area, for all
  // sources. 12 texels divide into 6, 4 and 1.
  const radiosity::Scene scene = tests::sceneOf({tests::parallelogram("a", {0, 0, 0}, {2, 0, 0}, {0, 3, 0}),
                                                 tests::parallelogram("b", {0, 0, 1}, {0, 1, 0}, {1, 0, 0})});
  const radiosity::Discretization fine = radiosity::discretize(scene, {.texels = 12, .patch = 5});
  const FormFactorMatrix matrix = asInASphere(fine);
  for (const auto& [texels, patch] : {std::pair{12, 5}, {12, 1}, {6, 2}, {4, 4}, {1, 1}}) {
    const radiosity::Discretization coarse = radiosity::discretize(scene, {.texels = texels, .patch = patch});
    const DenseRows rows = denseRows(matrix, fine, coarse);
    REQUIRE(rows.elements == coarse.elements.size());
    REQUIRE(rows.factors.size() == coarse.patches.list.size() * coarse.elements.size());
    for (std::size_t i = 0; i < rows.factors.size(); ++i)
      CHECK(rows.factors[i] == Approx(coarse.elements[i % rows.elements].area / 7).epsilon(1e-12));
  }
  // A matrix without symmetry: from element e all light goes to element e. A patch sends to each of its own elements
  // that element's share of its area.
  FormFactorMatrix identity{fine.elements.size(), std::vector<double>(fine.elements.size() * fine.elements.size())};
  for (std::size_t e = 0; e < identity.size; ++e) identity.factors[e * identity.size + e] = 1;
  const radiosity::Discretization coarse = radiosity::discretize(scene, {.texels = 4, .patch = 2});
  const DenseRows rows = denseRows(identity, fine, coarse);
  for (std::size_t p = 0; p < coarse.patches.list.size(); ++p)
    for (std::size_t e = 0; e < rows.elements; ++e)
      CHECK(rows.factors[p * rows.elements + e] == Approx(coarse.patches.ofElement[e] == p ? 0.25 : 0));
}

TEST_CASE("denseRows converts shares to factors, and gives zeros for missing rows", "[tradeoff]") {
  const radiosity::Scene scene = tests::sceneOf({tests::parallelogram("a", {0, 0, 0}, {1, 0, 0}, {0, 1, 0})});
  const radiosity::Discretization discretization = radiosity::discretize(scene, {.texels = 2, .patch = 1});
  std::vector<std::optional<radiosity::FormFactorRow>> rows(4);
  rows[2] = radiosity::FormFactorRow{.elements = {1, 3},
                                     .shares = {radiosity::wholeShare / 2, radiosity::wholeShare / 4},
                                     .background = {},
                                     .back = {}};
  std::vector<double> expected(16, 0.0);
  expected[2 * 4 + 1] = 0.5;
  expected[2 * 4 + 3] = 0.25;
  CHECK(denseRows(rows, discretization).factors == expected);
}
