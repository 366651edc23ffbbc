/// Facets: solve on facets, and the files of VTK that solve, formfactors and matrix write.
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <string>

#include "radiosity/meshes/vtk_xml_file.h"
#include "reference/matrices/matrix_files.h"
#include "reference/truth/solution/direct_solution.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::tests;
using nlohmann::json;

namespace {

const std::string box = HEMITEX_DATA "/cornell-box.obj";

/// The values of an array of a VTU file.
std::vector<double> cellData(const Shell& shell, const std::string& name, const std::string& array) {
  return radiosity::parseVtkXml(readAll(shell.file(name)), name, std::vector{array}).arrays.front().values;
}

std::vector<glm::dvec3> vectorsOf(const Shell& shell, const std::string& name, const std::string& array) {
  const std::vector<double> values = cellData(shell, name, array);
  std::vector<glm::dvec3> vectors;
  for (std::size_t i = 0; i < values.size(); i += 3) vectors.emplace_back(values[i], values[i + 1], values[i + 2]);
  return vectors;
}

reference::FormFactorMatrix denseOf(const reference::SparseMatrix& matrix) {
  const std::size_t facets = matrix.rows();
  reference::FormFactorMatrix dense{facets, std::vector<double>(facets * facets)};
  for (std::size_t r = 0; r < facets; ++r)
    for (std::size_t k = 0; k < matrix.row(r).column.size(); ++k)
      if (matrix.row(r).column[k] < facets)
        dense.factors[r * facets + matrix.row(r).column[k]] = matrix.row(r).value[k];
  return dense;
}

/// The largest difference of the radiosity of a solved folder from the dense solution of a matrix, over the largest
/// radiosity. `byRows` solves b = e + rho F b; otherwise fluxes go along the rows, which is the same for a matrix with
/// exact reciprocity.
double differenceFromDense(const Shell& shell, const std::string& folder, const std::string& matrixFile, bool byRows) {
  const reference::MatrixFile file = reference::readMatrix(shell.file(matrixFile));
  const std::vector<glm::dvec3> emission = vectorsOf(shell, folder + "/scene.vtu", "emission"),
                                reflectance = vectorsOf(shell, folder + "/scene.vtu", "reflectance"),
                                radiosity = vectorsOf(shell, folder + "/scene.vtu", "radiosity");
  reference::FormFactorMatrix matrix = denseOf(file.matrix);
  const std::size_t facets = file.area.size();
  std::vector<glm::dvec3> emitted;
  for (std::size_t f = 0; f < facets; ++f) emitted.push_back(emission[f] * (byRows ? 1 : file.area[f]));
  if (byRows) {  // solveDirectly takes the flux from i to j from entry i, j
    const reference::FormFactorMatrix original = matrix;
    for (std::size_t i = 0; i < facets; ++i)
      for (std::size_t j = 0; j < facets; ++j) matrix.factors[j * facets + i] = original.factors[i * facets + j];
  }
  const std::vector<glm::dvec3> found = reference::solveDirectly(matrix, emitted, reflectance);
  double apart = 0, largest = 0;
  for (std::size_t f = 0; f < facets; ++f)
    for (int band = 0; band < 3; ++band) {
      apart = std::max(apart, std::abs(found[f][band] / (byRows ? 1 : file.area[f]) - radiosity[f][band]));
      largest = std::max(largest, radiosity[f][band]);
    }
  return apart / largest;
}

}  // namespace

TEST_CASE("hemitex solve --matrix gives the dense solution of the matrix", "[cli]") {
  const Shell shell;
  shell.output("formfactors " + box + " --all --facets --max-error 0.01 -o F.npz");
  shell.output("solve " + box + " --matrix F.npz --residual 1e-9 --size 40x30 --no-textures -o lit");
  CHECK(differenceFromDense(shell, "lit", "F.npz", false) < 1e-8);
  CHECK(differenceFromDense(shell, "lit", "F.npz", true) < 0.01);  // of the reciprocity of the rows

  // A matrix of another format is the same.
  shell.output("formfactors " + box + " --all --facets --max-error 0.01 -o F.csv");
  shell.output("solve " + box + " --matrix F.csv --residual 1e-9 --size 40x30 --no-textures -o other");
  CHECK(readAll(shell.file("lit/scene.vtu")) == readAll(shell.file("other/scene.vtu")));
}

TEST_CASE("hemitex solve --facets --max-error shoots along the rows of formfactors --max-error", "[cli]") {
  const Shell shell;
  shell.output("formfactors " + box + " --all --facets --max-error 0.02 -o F.npz --vtu F.vtu");
  shell.output("solve " + box + " --facets --max-error 0.02 --size 40x30 --no-textures -o lit");
  const json solution = json::parse(readAll(shell.file("lit/solution.json")));
  CHECK(solution["elements"] == 19);
  CHECK(differenceFromDense(shell, "lit", "F.npz", false) < 2 * solution["residual"].get<double>());
  CHECK(solution["row_error"] < 0.02);
  CHECK(cellData(shell, "lit/scene.vtu", "row_error") == cellData(shell, "F.vtu", "error"));

  shell.output("solve " + box + " --facets --max-error 0.02 --size 40x30 --no-textures -o serial --threads 1");
  CHECK(readAll(shell.file("lit/scene.vtu")) == readAll(shell.file("serial/scene.vtu")));
}

TEST_CASE("hemitex solve makes facets of meshes without materials, with emission from cell data", "[cli]") {
  const Shell shell;
  shell.output("solve " + box + " --facets --residual 1e-6 --size 40x30 --no-textures -o lit");
  const std::string cells = "--cell-emission emission --cell-reflectance reflectance --residual 1e-6 --size 40x30 ";
  shell.output("solve lit/scene.vtu " + cells + "--no-textures -o again");
  const std::vector<double> once = cellData(shell, "lit/scene.vtu", "radiosity"),
                            again = cellData(shell, "again/scene.vtu", "radiosity");
  REQUIRE(once.size() == 3 * 19);
  for (std::size_t i = 0; i < once.size(); ++i) CHECK(again[i] == Approx(once[i]).epsilon(1e-12));
  CHECK(json::parse(readAll(shell.file("again/solution.json")))["elements"] == 19);

  shell.output("solve lit/scene.vtu " + cells + "--texels 4 --no-facets --no-textures -o joined");
  CHECK(json::parse(readAll(shell.file("joined/solution.json")))["elements"] > 100);
  CHECK_FALSE(exists(shell.file("joined/scene.vtu")));
}

TEST_CASE("hemitex solve refuses a matrix of another mesh, and options that facets have no use for", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets -o F.npz");
  writeAll(shell.file("one.csv"), "0 1 1\n1 0 0\n0 0 0.5\n");
  for (const std::string& arguments : std::vector<std::string>{
           box + " --matrix F.npz", "room.obj --matrix missing.npz", "room.obj --facets --two-sided",
           "room.obj --facets --no-facets", "room.obj --facets --max-error 0.1 --texels 4",
           "room.obj --matrix F.npz --resolution 64", "room.obj --cell-emission e", "room.obj --matrix one.csv"}) {
    CAPTURE(arguments);
    const Outcome outcome = shell.run("solve " + arguments + " -o lit");
    CHECK(outcome.exitCode == 2);
    CHECK_FALSE(exists(shell.file("lit")));
  }
}

TEST_CASE("hemitex formfactors --vtu writes what the matrix says of each facet", "[cli]") {
  const Shell shell;
  shell.output("formfactors " + box + " --all --facets --max-error 0.05 -o F.npz --vtu F.vtu --row 3 --row 0");
  const reference::SparseMatrix matrix = reference::readMatrix(shell.file("F.npz")).matrix;
  const reference::FormFactorMatrix dense = denseOf(matrix);
  const std::size_t facets = matrix.rows();
  for (const std::size_t row : {std::size_t{0}, std::size_t{3}}) {
    const std::vector<double> found = cellData(shell, "F.vtu", "form_factor_from_" + std::to_string(row));
    CHECK(found == std::vector<double>(dense.factors.begin() + static_cast<std::ptrdiff_t>(row * facets),
                                       dense.factors.begin() + static_cast<std::ptrdiff_t>((row + 1) * facets)));
    CHECK(cellData(shell, "F.vtu", "row_sum")[row] == std::accumulate(found.begin(), found.end(), 0.0));
    CHECK(cellData(shell, "F.vtu", "row_sum")[row] + cellData(shell, "F.vtu", "surroundings")[row] +
              cellData(shell, "F.vtu", "backs")[row] ==
          Approx(1));
  }
  CHECK(cellData(shell, "F.vtu", "error") ==
        json::parse(readAll(shell.file("F.json")))["errors"].get<std::vector<double>>());

  for (const char* arguments :
       {"room.obj --all --facets -o G.npz --vtu G.vtk", "room.obj --all --by-surface --vtu G.vtu",
        "room.obj --all --facets -o G.npz --vtu G.vtu --row 99", "room.obj --from walls --vtu G.vtu"}) {
    CAPTURE(arguments);
    CHECK(shell.run("formfactors " + std::string(arguments)).exitCode == 2);
    CHECK_FALSE(shell.files().contains("G.npz.part"));
  }
}

TEST_CASE("hemitex matrix compare --vtu writes the differences of its table", "[cli]") {
  const Shell shell;
  shell.output("formfactors " + box + " --all --facets --max-error 0.01 -o a.npz");
  shell.output("formfactors " + box + " --all --facets -o b.npz");
  const json table = json::parse(shell.output("matrix compare a.npz b.npz " + box + " --vtu d.vtu --json"));
  const std::vector<double> difference = cellData(shell, "d.vtu", "difference");
  REQUIRE(table["facets"].size() == difference.size());
  double sent = 0, received = 0;
  const std::vector<double> byReceiver = cellData(shell, "d.vtu", "difference_received");
  for (std::size_t f = 0; f < difference.size(); ++f) {
    CHECK(table["facets"][f]["difference"] == difference[f]);
    sent += difference[f] * table["facets"][f]["area"].get<double>();
    received += byReceiver[f] * table["facets"][f]["area"].get<double>();
  }
  CHECK(sent == Approx(received));
}
