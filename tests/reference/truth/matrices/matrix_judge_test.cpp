/// judgeMatrix: names faults that are injected into true matrices, and accuses no true one.
#include "reference/truth/matrices/matrix_judge.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <functional>
#include <map>
#include <numeric>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "reference/truth/closed_forms/quick_form_factor.h"
#include "reference/truth/facets/facet_form_factors.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::reference;

namespace {

using Dense = std::vector<std::vector<double>>;

/// The Cornell box, which is open in front, with two blocks: facets are its triangles and quads.
struct Box {
  Scene scene = loadScene(HEMITEX_DATA "/cornell-box.obj", {.facets = true});
  Discretization elements = discretize(scene, {.texels = 1, .isUnburied = true});
  std::size_t count = scene.surfaces.size();
  std::vector<double> area = std::vector<double>(count);
  FacetMesh mesh{scene, elements, std::vector<std::uint32_t>(count), count};
  Dense truth = Dense(count, std::vector<double>(count)), closed = truth;

  Box() {
    std::iota(mesh.facetOf.begin(), mesh.facetOf.end(), 0U);
    const RayFormFactors rays(scene, elements);
    for (std::uint32_t i = 0; i < count; ++i) {
      area[i] = elements.elements[elements.grids[i].firstElement].area;
      const MeasuredRow row =
          rays.overHemisphere(areaRaySource(rays.pieces(), std::vector{elements.grids[i].firstElement}),
                              everyElement(elements), {.samples = 1 << 18, .seed = 5});
      for (std::uint32_t e = 0; e < count; ++e) truth[i][elements.elements[e].surface] = row.receivers[e].value;
      for (std::uint32_t j = 0; j < count; ++j) closed[i][j] = quickFormFactor(scene.surfaces[i], scene.surfaces[j]);
    }
  }
};

const Box& box() {
  static const Box made;
  return made;
}

SparseMatrix sparse(const Dense& dense) {
  SparseMatrix matrix{dense.empty() ? 0 : dense.front().size()};
  for (const std::vector<double>& row : dense) {
    std::vector<std::uint32_t> columns(row.size());
    std::iota(columns.begin(), columns.end(), 0U);
    matrix.append({columns, row});
  }
  return matrix;
}

/// The true matrix with each entry replaced by change(i, j).
Dense changed(const std::function<double(std::size_t, std::size_t)>& change) {
  Dense result = box().truth;
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t j = 0; j < result.size(); ++j) result[i][j] = change(i, j);
  return result;
}

/// The true matrix of the mesh whose facets are all turned over.
Dense turnedOver() {
  Scene turned = box().scene;
  for (Surface& surface : turned.surfaces) turnOver(surface);
  const RayFormFactors rays(turned, box().elements);
  Dense result(box().count, std::vector<double>(box().count));
  for (std::uint32_t i = 0; i < box().count; ++i) {
    const MeasuredRow row =
        rays.overHemisphere(areaRaySource(rays.pieces(), std::vector{box().elements.grids[i].firstElement}),
                            everyElement(box().elements), {.samples = 1 << 18, .seed = 6});
    for (std::uint32_t e = 0; e < box().count; ++e)
      result[i][box().elements.elements[e].surface] = row.receivers[e].value;
  }
  return result;
}

/// Closed forms between facets whose centres see each other.
Dense byCentres() {
  const Scene& scene = box().scene;
  const RayCaster caster(scene);
  std::vector<std::uint32_t> surfaceOf, first;
  std::vector<glm::dvec3> centre;
  for (std::uint32_t s = 0; s < box().count; ++s) {
    first.push_back(static_cast<std::uint32_t>(surfaceOf.size()));
    centre.emplace_back(0);
    for (const Triangle& triangle : scene.surfaces[s].triangles) {
      surfaceOf.push_back(s);
      const auto& [a, b, c] = triangle.position;
      centre.back() += area(triangle) / box().area[s] / 3 * (a + b + c);
    }
  }
  return changed([&](std::size_t i, std::size_t j) {
    if (i == j) return 0.0;
    const auto hit =
        caster.firstHit({(centre[i] - scene.origin) / scene.extent, glm::normalize(centre[j] - centre[i]), first[i]});
    return hit && surfaceOf[hit->triangle] == j ? box().closed[i][j] : 0.0;
  });
}

bool hasProblem(const Dense& matrix, const std::string& text) {
  const MatrixVerdict verdict = judgeMatrix(sparse(matrix), box().mesh);
  return std::any_of(verdict.problems.begin(), verdict.problems.end(),
                     [&](const std::string& problem) { return problem.find(text) != std::string::npos; });
}

}  // namespace

TEST_CASE("judgeMatrix accuses no true matrix: of rays, or of hemicubes and closed forms", "[matrix_judge]") {
  const MatrixVerdict ofRays = judgeMatrix(sparse(box().truth), box().mesh);
  CAPTURE(ofRays.problems);
  CHECK(ofRays.problems.empty());
  CHECK_FALSE(ofRays.fault);
  CHECK(ofRays.difference < 0.01);
  CHECK(ofRays.measuredRows == box().count);

  SparseMatrix found{box().count + 2};
  FacetFormFactors factors(box().scene, box().elements, {.maxError = 0.01});
  for (std::uint32_t i = 0; i < box().count; ++i) {
    FacetRow row = factors.row(i);
    const auto count = static_cast<std::uint32_t>(box().count);
    row.facets.insert(row.facets.end(), {count, count + 1});
    row.factors.insert(row.factors.end(), {row.surroundings, row.backs});
    found.append({row.facets, row.factors});
  }
  const MatrixVerdict ofHemicubes = judgeMatrix(found, box().mesh);
  CAPTURE(ofHemicubes.problems);
  CHECK(ofHemicubes.problems.empty());
}

TEST_CASE("judgeMatrix names faults that are injected into a true matrix", "[matrix_judge]") {
  const Dense& f = box().truth;
  const Dense& u = box().closed;
  const std::vector<double>& area = box().area;
  const std::size_t last = box().count - 1;
  const auto sumOf = [&](std::size_t i) { return std::accumulate(f[i].begin(), f[i].end(), 0.0); };
  const std::map<std::string, Dense> faults{
      {"the matrix is transposed", changed([&](auto i, auto j) { return f[j][i]; })},
      {"each row is multiplied by the area of its facet", changed([&](auto i, auto j) { return area[i] * f[i][j]; })},
      {"each column is multiplied by the area of its facet",
       changed([&](auto i, auto j) { return area[j] * f[i][j]; })},
      {"entries are in percent", changed([&](auto i, auto j) { return 100 * f[i][j]; })},
      {"entries are multiplied by pi", changed([&](auto i, auto j) { return 3.14159265 * f[i][j]; })},
      {"entries are divided by pi", changed([&](auto i, auto j) { return f[i][j] / 3.14159265; })},
      {"facets are in reversed order", changed([&](auto i, auto j) { return f[last - i][last - j]; })},
      {"facets are shifted by one, as if counted from 1 instead of 0",
       changed([&](auto i, auto j) { return i == 0 || j == 0 ? 0.0 : f[i - 1][j - 1]; })},
      {"facets are shifted by one, as if counted from 0 instead of 1",
       changed([&](auto i, auto j) { return i == last || j == last ? 0.0 : f[i + 1][j + 1]; })},
      {"blockers are ignored", u},
      {"all normals are turned over", turnedOver()},
      {"partly hidden pairs are decided by their centres", byCentres()},
      {"blockers count twice",
       changed([&](auto i, auto j) { return u[i][j] > 0 ? f[i][j] * std::min(f[i][j] / u[i][j], 1.0) : 0.0; })},
      {"rows are normalized to 1, although light leaves the mesh",
       changed([&](auto i, auto j) { return sumOf(i) > 0 ? f[i][j] / sumOf(i) : 0.0; })},
  };
  for (const auto& [name, matrix] : faults) {
    const MatrixVerdict verdict = judgeMatrix(sparse(matrix), box().mesh);
    CAPTURE(name, verdict.problems, verdict.difference);
    CHECK_FALSE(verdict.problems.empty());
    CHECK(verdict.fault.value_or("none") == name);
  }
}

TEST_CASE("judgeMatrix names a file that is cut off, a row without entries and a facet that sees itself",
          "[matrix_judge]") {
  Dense cut = box().truth;
  cut.resize(box().count / 2);
  const MatrixVerdict ofCut = judgeMatrix(sparse(cut), box().mesh);
  REQUIRE(ofCut.fault);
  CHECK(ofCut.fault->find("cut off") != std::string::npos);

  Dense empty = box().truth;
  empty[0].assign(box().count, 0);
  CHECK(hasProblem(empty, "0 where something is seen"));

  Dense self = box().truth;
  self[3][3] = 0.2;
  CHECK(hasProblem(self, "see themselves"));

  Dense wrong = box().truth;
  wrong[0][1] = -0.1;
  CHECK(hasProblem(wrong, "outside [0, 1]"));
}
