/// judgeMatrix: names faults that are injected into true matrices, and accuses no true one.
#include "reference/matrices/matrix_judge.h"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <optional>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/mesh_sections.h"
#include "raster/base/parallel.h"
#include "reference/matrices/facet_order.h"
#include "reference/rows/facet_form_factors.h"
#include "reference/truth/closed_forms/quick_form_factor.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::radiosity;
using namespace hemitex::reference;

namespace {

using Dense = std::vector<std::vector<double>>;

const JudgeSettings quick{.samples = 1 << 13};

/// A mesh with its true matrix, by rays, and closed forms. Facets without a surface have empty rows and columns.
struct Judged {
  Scene scene;
  Discretization elements = discretize(scene, {.texels = 1, .isUnburied = true});
  std::size_t count = scene.faces;
  std::vector<double> area = std::vector<double>(count);
  FacetMesh mesh{scene, elements, {}, count};
  Dense truth = Dense(count, std::vector<double>(count)), closed = truth;

  explicit Judged(const std::filesystem::path& file) : scene(loadScene(file, {.facets = true})) {
    for (const Surface& surface : scene.surfaces) mesh.facetOf.push_back(surface.triangles.front().polygon);
    const std::vector<std::uint32_t> first = firstOfEqual(readFaces(file));
    for (std::uint32_t f = 0; f < count; ++f)
      if (first[f] != f) mesh.repeated.emplace_back(f, first[f]);
    truth = rowsByRays(scene, 5);
    for (std::uint32_t a = 0; a < scene.surfaces.size(); ++a) {
      area[mesh.facetOf[a]] = radiosity::area(scene.surfaces[a]);
      for (std::uint32_t b = 0; b < scene.surfaces.size(); ++b)
        closed[mesh.facetOf[a]][mesh.facetOf[b]] =
            quickFormFactor(convexPolygons(scene, scene.surfaces[a]), convexPolygons(scene, scene.surfaces[b]));
    }
  }

  /// The rows of a scene with the same facets.
  Dense rowsByRays(const Scene& other, std::uint32_t seed) const {
    const RayFormFactors rays(other, elements);
    Dense rows(count, std::vector<double>(count));
    for (std::uint32_t s = 0; s < other.surfaces.size(); ++s) {
      const MeasuredRow row =
          rays.overHemisphere(areaRaySource(rays.pieces(), std::vector{elements.grids[s].firstElement}),
                              everyElement(elements), {.samples = 1 << 17, .seed = seed});
      for (std::uint32_t e = 0; e < elements.elements.size(); ++e)
        rows[mesh.facetOf[s]][mesh.facetOf[elements.elements[e].surface]] = row.receivers[e].value;
    }
    return rows;
  }

  /// The true matrix with each entry replaced by change(i, j).
  Dense changed(const std::function<double(std::size_t, std::size_t)>& change) const {
    Dense result = truth;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) result[i][j] = change(i, j);
    return result;
  }

  /// The true matrix of the mesh whose facets are all turned over, or one of them.
  Dense turnedOver(std::optional<std::uint32_t> only = {}) const {
    Scene turned = scene;
    for (std::uint32_t s = 0; s < turned.surfaces.size(); ++s)
      if (!only || *only == mesh.facetOf[s]) turnOver(turned.surfaces[s]);
    return rowsByRays(turned, 6);
  }

  /// Closed forms between facets whose centres see each other. All facets have surfaces.
  Dense byCentres() const {
    const RayCaster caster(scene);
    std::vector<std::uint32_t> surfaceOf, first;
    std::vector<glm::dvec3> centre;
    for (std::uint32_t s = 0; s < count; ++s) {
      first.push_back(static_cast<std::uint32_t>(surfaceOf.size()));
      centre.emplace_back(0);
      for (const Triangle& triangle : scene.surfaces[s].triangles) {
        surfaceOf.push_back(s);
        const auto& [a, b, c] = triangle.position;
        centre.back() += radiosity::area(triangle) / area[s] / 3 * (a + b + c);
      }
    }
    return changed([&](std::size_t i, std::size_t j) {
      if (i == j) return 0.0;
      const auto hit =
          caster.firstHit({(centre[i] - scene.origin) / scene.extent, glm::normalize(centre[j] - centre[i]), first[i]});
      return hit && surfaceOf[hit->triangle] == j ? closed[i][j] : 0.0;
    });
  }
};

/// The Cornell box, which is open in front, with two blocks: facets are its triangles and quads.
const Judged& box() {
  static const Judged made(HEMITEX_DATA "/cornell-box.obj");
  return made;
}

void addQuad(std::string& obj, const std::array<glm::dvec3, 4>& corners) {
  for (const glm::dvec3& p : corners)
    obj += "v " + std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  obj += "f -4 -3 -2 -1\n";
}

/// Blocks of different heights on a ground, under the sky.
const Judged& city() {
  static const Judged made = [] {
    std::string obj;
    addQuad(obj, {glm::dvec3(-1, 0, -1), {-1, 0, 8}, {9, 0, 8}, {9, 0, -1}});
    for (int street = 0; street < 3; ++street)
      for (int house = 0; house < 3; ++house) {
        const double x = 3 * street, z = 2.5 * house, h = 1 + 0.5 * street + 0.3 * house, w = 1.5,
                     d = 1.2 + 0.1 * house;
        const std::array<glm::dvec3, 4> base{glm::dvec3(x, 0, z), {x, 0, z + d}, {x + w, 0, z + d}, {x + w, 0, z}};
        std::array<glm::dvec3, 4> roof = base;
        for (glm::dvec3& corner : roof) corner.y = h;
        addQuad(obj, roof);
        for (std::size_t k = 0; k < 4; ++k) addQuad(obj, {base[k], base[(k + 1) % 4], roof[(k + 1) % 4], roof[k]});
      }
    const TemporaryFolder folder;
    tests::writeAll(folder.path / "city.obj", obj);
    return Judged(folder.path / "city.obj");
  }();
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

bool hasProblem(const Dense& matrix, const std::string& text) {
  const MatrixVerdict verdict = judgeMatrix(sparse(matrix), box().mesh, quick);
  return std::any_of(verdict.problems.begin(), verdict.problems.end(),
                     [&](const std::string& problem) { return problem.find(text) != std::string::npos; });
}

/// A permutation that has no rule, from a seed.
std::vector<std::size_t> shuffled(std::size_t count) {
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::uint64_t state = 12345;
  for (std::size_t k = count; k > 1; --k) {
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    std::swap(order[k - 1], order[(state >> 33) % k]);
  }
  return order;
}

/// The faults, by the names that the judge gives them, with the matrix of a mesh that has them.
std::map<std::string, Dense> faultsOf(const Judged& mesh) {
  const Dense& f = mesh.truth;
  const Dense& u = mesh.closed;
  const std::vector<double>& area = mesh.area;
  const std::size_t last = mesh.count - 1;
  const std::vector<std::size_t> order = shuffled(mesh.count);
  const auto swapped = [](std::size_t k) { return k == 3 ? std::size_t{5} : k == 5 ? std::size_t{3} : k; };
  const auto sumOf = [&](std::size_t i) { return std::accumulate(f[i].begin(), f[i].end(), 0.0); };
  return {
      {"the matrix is transposed", mesh.changed([&](auto i, auto j) { return f[j][i]; })},
      {"each row is multiplied by the area of its facet",
       mesh.changed([&](auto i, auto j) { return area[i] * f[i][j]; })},
      {"each column is multiplied by the area of its facet",
       mesh.changed([&](auto i, auto j) { return area[j] * f[i][j]; })},
      {"entries are in percent", mesh.changed([&](auto i, auto j) { return 100 * f[i][j]; })},
      {"entries are multiplied by pi", mesh.changed([&](auto i, auto j) { return 3.14159265 * f[i][j]; })},
      {"entries are divided by pi", mesh.changed([&](auto i, auto j) { return f[i][j] / 3.14159265; })},
      {"facets are in reversed order", mesh.changed([&](auto i, auto j) { return f[last - i][last - j]; })},
      {"facets are shifted by one, as if counted from 1 instead of 0",
       mesh.changed([&](auto i, auto j) { return i == 0 || j == 0 ? 0.0 : f[i - 1][j - 1]; })},
      {"facets are shifted by one, as if counted from 0 instead of 1",
       mesh.changed([&](auto i, auto j) { return i == last || j == last ? 0.0 : f[i + 1][j + 1]; })},
      {"facets are in another order", mesh.changed([&](auto i, auto j) { return f[order[i]][order[j]]; })},
      {"blockers are ignored", u},
      {"all entries are multiplied by", mesh.changed([&](auto i, auto j) { return 0.9 * f[i][j]; })},
      {"the row of facet 3 is multiplied by",
       mesh.changed([&](auto i, auto j) { return f[i][j] * (i == 3 ? 1.1 : 1); })},
      {"the column of facet 3 is multiplied by",
       mesh.changed([&](auto i, auto j) { return f[i][j] * (j == 3 ? 1.1 : 1); })},
      {"facets 3 and 5 are exchanged", mesh.changed([&](auto i, auto j) { return f[swapped(i)][swapped(j)]; })},
      {"the normal of facet 4 is turned over", mesh.turnedOver(4)},
      {"entries are averaged with their opposites, without areas",
       mesh.changed([&](auto i, auto j) { return (f[i][j] + f[j][i]) / 2; })},
      {"entries below", mesh.changed([&](auto i, auto j) { return f[i][j] < 0.03 ? 0.0 : f[i][j]; })},
      {"rows are shifted by one, but not columns",
       mesh.changed([&](auto i, auto j) { return f[(i + 1) % mesh.count][j]; })},
      {"all normals are turned over", mesh.turnedOver()},
      {"partly hidden pairs are decided by their centres", mesh.byCentres()},
      {"blockers count twice",
       mesh.changed([&](auto i, auto j) { return u[i][j] > 0 ? f[i][j] * std::min(f[i][j] / u[i][j], 1.0) : 0.0; })},
      {"rows are normalized to 1, although light leaves the mesh",
       mesh.changed([&](auto i, auto j) { return sumOf(i) > 0 ? f[i][j] / sumOf(i) : 0.0; })},
  };
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
  FacetFormFactors factors(box().scene, {.maxError = 0.01});
  for (std::uint32_t i = 0; i < box().count; ++i) {
    const SparseRow row = factors.row(i);
    found.append({row.column, row.value});
  }
  const MatrixVerdict ofHemicubes = judgeMatrix(found, box().mesh);
  CAPTURE(ofHemicubes.problems);
  CHECK(ofHemicubes.problems.empty());
}

TEST_CASE("judgeMatrix names faults that are injected into true matrices, as the table of docs/matrices.md says",
          "[matrix_judge]") {
  const std::string documents = tests::readAll(HEMITEX_DOCS "/matrices.md");
  const auto nameIn = [](const Judged& mesh, const Dense& matrix) {
    const MatrixVerdict verdict = judgeMatrix(sparse(matrix), mesh.mesh, quick);
    CHECK_FALSE(verdict.problems.empty());
    return verdict.fault.value_or("not named");
  };
  const std::map<std::string, Dense> ofBox = faultsOf(box()), ofCity = faultsOf(city());
  for (const auto& [fault, matrix] : ofBox) {
    const std::string inBox = nameIn(box(), matrix), inCity = nameIn(city(), ofCity.at(fault));
    CAPTURE(fault, inBox, inCity);
    const auto word = [&fault = fault](const std::string& found) {
      return found.starts_with(fault) ? "named" : found == "not named" ? "wrong, not named" : found;
    };
    CHECK(inBox.starts_with(fault));
    CHECK(documents.find("| " + fault + " | " + word(inBox) + " | " + word(inCity) + " |\n") != std::string::npos);
  }
}

TEST_CASE("judgeMatrix names the factor of all entries, also where it makes rows sum to about 1", "[matrix_judge]") {
  for (const Judged* mesh : {&box(), &city()})
    for (const double factor : {0.5, 0.9, 1.1, 1.2, 2.0}) {
      const Dense matrix = mesh->changed([&](auto i, auto j) { return factor * mesh->truth[i][j]; });
      const std::string fault = judgeMatrix(sparse(matrix), mesh->mesh, quick).fault.value_or("not named");
      CAPTURE(factor, fault);
      REQUIRE(fault.starts_with("all entries are multiplied by "));
      CHECK(std::abs(std::stod(fault.substr(fault.rfind(' '))) / factor - 1) < 0.01);
    }
}

TEST_CASE("judgeMatrix joins facets in one place, and names the fault that both are seen", "[matrix_judge]") {
  // The box with its back wall twice.
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path / "doubled.obj";
  std::string obj = tests::readAll(HEMITEX_DATA "/cornell-box.obj");
  const std::size_t wall = obj.find("\nf ", obj.find("wall-back"));
  REQUIRE(wall != obj.npos);
  obj += "\ng twice\nusemtl white\n" + obj.substr(wall + 1, obj.find('\n', wall + 1) - wall);
  tests::writeAll(file, obj);
  const Judged mesh = [&] {
    std::filesystem::copy_file(HEMITEX_DATA "/cornell-box.mtl", folder.path / "cornell-box.mtl");
    return Judged(file);
  }();
  REQUIRE(mesh.mesh.repeated.size() == 1);
  const auto [repetition, original] = mesh.mesh.repeated.front();

  const MatrixVerdict ofFirst = judgeMatrix(sparse(mesh.truth), mesh.mesh, quick);
  CAPTURE(ofFirst.problems);
  CHECK(ofFirst.problems.empty());

  // Half of the light to either of the two is as true.
  Dense halves = mesh.truth, both = mesh.truth;
  for (std::size_t i = 0; i < mesh.count; ++i) {
    halves[i][original] = halves[i][repetition] = mesh.truth[i][original] / 2;
    both[i][repetition] = mesh.truth[i][original];
    both[repetition][i] = mesh.truth[original][i];
  }
  halves[repetition] = mesh.truth[original];
  const MatrixVerdict ofHalves = judgeMatrix(sparse(halves), mesh.mesh, quick);
  CAPTURE(ofHalves.problems);
  CHECK(ofHalves.problems.empty());

  const MatrixVerdict ofBoth = judgeMatrix(sparse(both), mesh.mesh, quick);
  CAPTURE(ofBoth.problems);
  CHECK_FALSE(ofBoth.problems.empty());
  CHECK(ofBoth.fault.value_or("none") == "facets in one place are all visible, such as facet " +
                                             std::to_string(original) + " and " + std::to_string(repetition));
}

TEST_CASE("judgeMatrix accuses no true matrix of solids that touch each other", "[matrix_judge]") {
  // Books in a shelf. Light of a buried side meets a front and a back in one place.
  const Scene scene = loadScene(HEMITEX_DATA "/furnished-room.obj", {.facets = true});
  const Discretization elements = discretize(scene, {.texels = 1, .isUnburied = true});
  REQUIRE(scene.faces == scene.surfaces.size());
  FacetMesh mesh{scene, elements, std::vector<std::uint32_t>(scene.faces), scene.faces};
  std::iota(mesh.facetOf.begin(), mesh.facetOf.end(), 0U);
  SparseMatrix found{scene.faces};
  FacetFormFactors factors(scene, {.maxError = 0.02});
  std::vector<SparseRow> rows(scene.faces);
  raster::parallelFor(rows.size(), [&](std::size_t f) { rows[f] = factors.row(static_cast<std::uint32_t>(f)); });
  for (SparseRow& row : rows) {
    row.takeOutside(scene.faces);
    found.append(row);
  }
  const MatrixVerdict verdict = judgeMatrix(found, mesh, quick);
  CAPTURE(verdict.problems);
  CHECK(verdict.problems.empty());

  // Percent are wrong there, too.
  for (double& value : found.value) value *= 100;
  CHECK(judgeMatrix(found, mesh, {.rows = 8, .samples = 1 << 14}).fault.value_or("none") == "entries are in percent");
}

TEST_CASE("judgeMatrix names facets right behind others that are seen", "[matrix_judge]") {
  // A room of which two walls are double, 2 mm apart.
  std::string obj;
  const auto room = [&](double size, double height) {
    const double h = height, r = size;
    addQuad(obj, {glm::dvec3(-r, -r, h), {r, -r, h}, {r, r, h}, {-r, r, h}});
    addQuad(obj, {glm::dvec3(-r, r, 2), {r, r, 2}, {r, -r, 2}, {-r, -r, 2}});
  };
  room(1, 0);
  room(1, -0.002);
  addQuad(obj, {glm::dvec3(-1, -1, 0), {-1, 1, 0}, {-1, 1, 2}, {-1, -1, 2}});
  addQuad(obj, {glm::dvec3(1, -1, 0), {1, -1, 2}, {1, 1, 2}, {1, 1, 0}});
  const TemporaryFolder folder;
  tests::writeAll(folder.path / "room.obj", obj);
  const Judged mesh(folder.path / "room.obj");
  CHECK(judgeMatrix(sparse(mesh.truth), mesh.mesh, quick).problems.empty());
  Dense seen = mesh.truth;
  for (std::size_t i = 0; i < mesh.count; ++i)
    if (i != 0 && i != 2) seen[i][2] = mesh.truth[i][0];
  CHECK(judgeMatrix(sparse(seen), mesh.mesh, quick).fault.value_or("none") ==
        "facets right behind others are visible, such as facet 0 and 2");
}

TEST_CASE("judgeMatrix takes errors that a matrix states into account, and says if they are too small",
          "[matrix_judge]") {
  SparseMatrix rough = sparse(box().truth);
  for (std::size_t k = 0; k < rough.value.size(); ++k) {
    rough.error.push_back(0.15 * rough.value[k]);
    rough.value[k] *= k % 2 == 0 ? 1.12 : 0.88;
  }
  const auto isWrong = [](const SparseMatrix& matrix, const std::string& text) {
    const MatrixVerdict verdict = judgeMatrix(matrix, box().mesh, {.samples = 1 << 15});
    return std::any_of(verdict.problems.begin(), verdict.problems.end(),
                       [&](const std::string& problem) { return problem.find(text) != std::string::npos; });
  };
  CHECK_FALSE(isWrong(rough, "differ from rays;"));
  CHECK_FALSE(isWrong(rough, "the errors that the matrix states"));
  for (double& error : rough.error) error /= 30;
  CHECK(isWrong(rough, "differ from rays;"));
  CHECK(isWrong(rough, "times the errors that the matrix states"));
}

TEST_CASE("facetOrder finds the order of up to a thousand facets, also of symmetric meshes", "[matrix_judge]") {
  for (const std::size_t size : {std::size_t{40}, std::size_t{300}, maxOrderedFacets}) {
    // Points on a torus of lines: each facet sees others by their distance, with a symmetry of four.
    FormFactorMatrix truth{size, std::vector<double>(size * size)}, given = truth;
    const auto distance = [&](std::size_t i, std::size_t j) {
      const double apart = std::abs(static_cast<double>(i) - static_cast<double>(j)) / static_cast<double>(size);
      return std::min(apart, 1 - apart);
    };
    const std::vector<std::size_t> order = shuffled(size);
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        const double noise = 1 + 0.05 * (static_cast<double>((i * 7919 + j * 104729) % 100) / 50 - 1);
        const double factor = i == j ? 0 : std::exp(-40 * distance(i, j)) * (1 + 0.5 * (i % 3 == 0));
        truth.factors[i * size + j] = factor * noise;
        given.factors[order[i] * size + order[j]] = factor;
      }
    const auto found = facetOrder(given, truth);
    CAPTURE(size);
    REQUIRE(found);
    double apart = 0, sum = 0;
    for (std::size_t i = 0; i < size; ++i)
      for (std::size_t j = 0; j < size; ++j) {
        apart += std::abs(truth.at(i, j) - given.at((*found)[i], (*found)[j]));
        sum += truth.at(i, j);
      }
    CHECK(apart / sum < 0.06);
  }
  FormFactorMatrix one{2, {0, 1, 1, 0}}, other{2, {0.5, 0, 0, 0.5}};
  CHECK_FALSE(facetOrder(other, one));
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
