/// FacetFormFactors: rows with an estimated error, against closed forms and rays.
#include "reference/rows/facet_form_factors.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/parallel.h"
#include "reference/truth/closed_forms/polygon_to_polygon.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "tests/support/hand_scenes.h"
#include "tests/support/picture_scenes.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::reference;

namespace {

double sumOf(const SparseRow& row) { return std::accumulate(row.value.begin(), row.value.end(), 0.0); }

/// Each triangle of a scene as a facet.
Scene facetsOf(const Scene& scene) {
  Scene facets = scene;
  facets.surfaces.clear();
  for (const Surface& surface : scene.surfaces)
    for (const Triangle& triangle : surface.triangles) {
      facets.surfaces.push_back(surface);
      facets.surfaces.back().name = std::to_string(facets.surfaces.size());
      facets.surfaces.back().triangles = {triangle};
    }
  return facets;
}

/// Rows of facets by rays.
class RowTruth {
 public:
  RowTruth(const Scene& scene, const DiscretizationSettings& settings)
      : elements_(discretize(scene, settings)), rays_(scene, elements_), receivers_(everyElement(elements_)) {}

  /// The sum of the absolute differences of a row from the truth, and of the standard errors of the truth.
  std::pair<double, double> errorOf(std::uint32_t facet, const SparseRow& row, int samples) const {
    const MeasuredRow truth = rays_.overHemisphere(
        areaRaySource(rays_.pieces(), std::vector{elements_.grids[facet].firstElement}), receivers_, {.samples = samples});
    const std::vector<double> found = row.spread(row.value, elements_.grids.size());
    double error = 0, noise = 0;
    for (std::uint32_t e = 0; e < elements_.elements.size(); ++e) {
      error += std::abs(found[elements_.elements[e].surface] - truth.receivers[e].value);
      noise += truth.receivers[e].standardError;
    }
    return {error, noise};
  }

 private:
  Discretization elements_;
  RayFormFactors rays_;
  Receivers receivers_;
};

}  // namespace

TEST_CASE("FacetFormFactors of an empty room are closed forms: everything is visible", "[facets]") {
  const Scene room = facetsOf(tests::makeRoom());
  const Discretization elements = discretize(room, {.texels = 1});
  FacetFormFactors factors(room, {.maxError = 0.01});
  for (std::uint32_t i = 0; i < room.surfaces.size(); ++i) {
    SparseRow row = factors.row(i);
    CHECK(sumOf(row) == Approx(1).epsilon(1e-12));
    row.takeOutside(room.surfaces.size());
    for (std::size_t k = 0; k < row.column.size(); ++k) {
      const double exact =
          polygonToPolygon(room.surfaces[i].triangles[0].position, room.surfaces[row.column[k]].triangles[0].position);
      CHECK(row.value[k] == Approx(exact).epsilon(2e-3));
    }
    CHECK(*row.rowError < 0.005);  // a pixel at the pole is 0.0003
  }
}

TEST_CASE("FacetFormFactors of a street are closed forms, however few pixels a facet covers", "[facets]") {
  std::vector<Surface> street;
  for (int i = 0; i < 12; ++i) {
    street.push_back(tests::parallelogram("", {10 * i, 0, 0}, {10, 0, 0}, {0, 1, 0}));
    street.push_back(tests::parallelogram("", {10 * i, 1, 0}, {10, 0, 0}, {0, 0, 3}));
  }
  const Scene scene = tests::sceneOf(street);
  FacetFormFactors factors(scene, {.maxError = 0.01});
  const std::vector<ConvexPolygons> polygons = convexPolygons(scene);
  for (std::uint32_t i = 0; i < street.size(); ++i) {
    const SparseRow row = factors.row(i);
    CHECK(*row.rowError < 0.01);
    double sum = 0;
    for (std::size_t k = 0; k < row.column.size() && row.column[k] < street.size(); ++k) {
      const double exact = polygonToPolygon(polygons[i][0], polygons[row.column[k]][0]);
      CHECK(row.value[k] == Approx(exact).epsilon(3e-3));
      sum += exact;
    }
    CHECK(row.value[row.value.size() - 2] == Approx(1 - sum).margin(1e-4));  // surroundings
  }
}

TEST_CASE("FacetFormFactors between walls 2 mm apart, behind a slit and at a contact keep their errors", "[facets]") {
  const auto join = [](std::vector<Surface> a, const std::vector<Surface>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  const std::vector<Surface> room = tests::box("room", {0, 0, 0}, {1, 1, 1}, true);
  const std::vector<std::vector<Surface>> scenes{
      join(room, tests::box("inner", glm::dvec3(0.002), glm::dvec3(0.996), false)),
      join(join(room, tests::box("left", {0.45, 0, 0}, {0.1, 0.4975, 1}, false)),
           tests::box("right", {0.45, 0.5025, 0}, {0.1, 0.4975, 1}, false)),
      join(room, tests::box("block", {0.1, 0.2, 0.6}, {0.3, 0.5, 0.4}, false))};
  for (std::size_t s = 0; s < scenes.size(); ++s) {
    const Scene scene = withoutBuried(tests::sceneOf(scenes[s]));
    const RowTruth truth(scene, {.texels = 1});
    FacetFormFactors factors(scene, {.maxError = 0.01});
    for (std::uint32_t i = 0; i < 6; ++i) {
      CAPTURE(s, i);
      const SparseRow row = factors.row(i);
      CHECK(sumOf(row) == Approx(1).epsilon(1e-12));
      const auto [error, noise] = truth.errorOf(i, row, 1 << 17);
      CHECK(error <= *row.rowError + noise);
      CHECK(error < 0.03);
    }
  }
}

TEST_CASE("FacetFormFactors with blockers agree with rays within their estimated error", "[facets]") {
  const Scene box = withoutBuried(loadScene(HEMITEX_DATA "/cornell-box.obj", {.facets = true}));
  const RowTruth truth(box, {.texels = 1, .isUnburied = true});
  FacetFormFactors factors(box, {.maxError = 0.01});
  for (std::uint32_t i = 0; i < box.surfaces.size(); ++i) {
    CAPTURE(i);
    const SparseRow row = factors.row(i);
    CHECK(sumOf(row) == Approx(1).epsilon(1e-12));
    CHECK(*row.rowError <= 0.01);
    const auto [error, noise] = truth.errorOf(i, row, 1 << 18);
    CHECK(error <= *row.rowError + noise);
  }
}

TEST_CASE("FacetFormFactors give the same bits whatever was asked before, with any number of threads", "[facets]") {
  const Scene box = loadScene(HEMITEX_DATA "/cornell-box.obj", {.facets = true});
  const Discretization elements = discretize(box, {.texels = 1, .isUnburied = true});
  const auto rowsOf = [&](int threads) {
    const raster::ThreadLimit limit(threads);
    FacetFormFactors factors(box, {.maxError = 0.05});
    std::vector<SparseRow> rows(box.surfaces.size());
    raster::parallelFor(rows.size(), [&](std::size_t i) { rows[i] = factors.row(static_cast<std::uint32_t>(i)); });
    return rows;
  };
  const std::vector<SparseRow> one = rowsOf(1), two = rowsOf(2);
  for (std::size_t i = 0; i < one.size(); ++i) {
    CHECK(one[i].column == two[i].column);
    CHECK(one[i].value == two[i].value);
    CHECK(one[i].rowError == two[i].rowError);
  }
}
