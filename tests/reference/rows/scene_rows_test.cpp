// Rows by each method: one form, which closes where blockers count.
#include "reference/rows/scene_rows.h"

#include <catch2/catch.hpp>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"

using namespace hemitex;
using namespace hemitex::reference;

TEST_CASE("Rows of each RowMethod ascend, and sum to 1 with surroundings and backs", "[rows]") {
  const radiosity::Scene scene = radiosity::loadScene(HEMITEX_DATA "/cornell-box.obj", {.facets = true});
  const radiosity::Discretization elements = radiosity::discretize(scene, {.texels = 1, .isUnburied = true});
  const RowReceivers receivers = familiesAsReceivers(elements, radiosity::facetsOf(scene));
  const std::size_t count = receivers.area.size();
  const auto check = [&](const RowMethod& method, bool hasErrors, bool hasBlockers) {
    SparseRow row = method.row({{3}});
    CHECK(std::adjacent_find(row.column.begin(), row.column.end(), std::greater_equal<>()) == row.column.end());
    CHECK(row.value.size() == row.column.size());
    CHECK(row.error.size() == (hasErrors ? row.column.size() : 0));
    if (hasBlockers) CHECK(std::accumulate(row.value.begin(), row.value.end(), 0.0) == Approx(1).epsilon(1e-12));
    CHECK(row.takeOutside(count).backs.has_value() == hasBlockers);
    REQUIRE_FALSE(row.column.empty());
    CHECK(row.column.back() < count);
  };
  check(drawnMethod(scene, elements, receivers, radiosity::layOut(elements), {.resolution = 32}), false, true);
  check(facetMethod(scene, receivers, 0.1, 2), true, true);
  check(rayMethod(scene, elements, receivers, {.samples = 1024}), true, true);
  check(analyticMethod(scene, elements, receivers), false, false);
}

TEST_CASE("drawnMethod says what its projection captures", "[rows]") {
  const radiosity::Scene scene = radiosity::loadScene(HEMITEX_DATA "/cornell-box.obj");
  const radiosity::Discretization elements = radiosity::discretize(scene, {.texels = 2});
  const RowReceivers receivers = elementsAsReceivers(elements);
  const auto captured = [&](radiosity::ProjectionKind kind) {
    return drawnMethod(scene, elements, receivers, radiosity::layOut(elements), {.resolution = 32, .projection = kind})
        .captured;
  };
  CHECK(captured(radiosity::ProjectionKind::Hemicube) == 1);
  CHECK(captured(radiosity::ProjectionKind::SinglePlane) < 1);
  CHECK_FALSE(analyticMethod(scene, elements, receivers).captured);
}
