/// Facets: solve on facets, and the files of VTK that solve, formfactors and matrix write.
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>
#include <sstream>
#include <string>

#include "radiosity/meshes/mesh_formats.h"
#include "reference/matrices/matrix_files.h"
#include "reference/truth/solution/direct_solution.h"
#include "tests/support/shell.h"
#include "tests/support/solved_folder.h"

using namespace hemitex;
using namespace hemitex::tests;
using nlohmann::json;

namespace {

const std::string cornellBox = HEMITEX_DATA "/cornell-box.obj";

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
  shell.output("formfactors " + cornellBox + " --all --facets --max-error 0.01 -o F.npz");
  shell.output("solve " + cornellBox + " --matrix F.npz --residual 1e-9 --size 40x30 --no-textures -o lit");
  CHECK(differenceFromDense(shell, "lit", "F.npz", false) < 1e-8);
  CHECK(differenceFromDense(shell, "lit", "F.npz", true) < 0.01);  // of the reciprocity of the rows

  // A matrix of another format is the same.
  shell.output("formfactors " + cornellBox + " --all --facets --max-error 0.01 -o F.csv");
  shell.output("solve " + cornellBox + " --matrix F.csv --residual 1e-9 --size 40x30 --no-textures -o other");
  CHECK(readAll(shell.file("lit/scene.vtu")) == readAll(shell.file("other/scene.vtu")));
}

TEST_CASE("hemitex solve --facets --max-error shoots along the rows of formfactors --max-error", "[cli]") {
  const Shell shell;
  shell.output("formfactors " + cornellBox + " --all --facets --max-error 0.02 -o F.npz --vtu F.vtu");
  shell.output("solve " + cornellBox + " --facets --max-error 0.02 --size 40x30 --no-textures -o lit");
  const json solution = solutionOf(shell, "lit");
  CHECK(solution["elements"] == 19);
  CHECK(differenceFromDense(shell, "lit", "F.npz", false) < 2 * solution["residual"].get<double>());
  CHECK(solution["row_error"] <= 0.02);
  // Only the matrix has both measurements of a pair, which may widen its errors.
  const std::vector<double> ofRows = cellData(shell, "lit/scene.vtu", "row_error"),
                            ofMatrix = cellData(shell, "F.vtu", "error");
  for (std::size_t i = 0; i < 19; ++i) CHECK(ofRows[i] <= ofMatrix[i]);

  shell.output("solve " + cornellBox + " --facets --max-error 0.02 --size 40x30 --no-textures -o serial --threads 1");
  CHECK(readAll(shell.file("lit/scene.vtu")) == readAll(shell.file("serial/scene.vtu")));
}

TEST_CASE("hemitex solve makes facets of meshes without materials, with emission from cell data", "[cli]") {
  const Shell shell;
  shell.output("solve " + cornellBox + " --facets --residual 1e-6 --size 40x30 --no-textures -o lit");
  const std::string cells = "--cell-emission emission --cell-reflectance reflectance --residual 1e-6 --size 40x30 ";
  shell.output("solve lit/scene.vtu " + cells + "--no-textures -o again");
  const std::vector<double> once = cellData(shell, "lit/scene.vtu", "radiosity"),
                            again = cellData(shell, "again/scene.vtu", "radiosity");
  REQUIRE(once.size() == 3 * 19);
  for (std::size_t i = 0; i < once.size(); ++i) CHECK(again[i] == Approx(once[i]).epsilon(1e-12));
  CHECK(solutionOf(shell, "again")["elements"] == 19);

  shell.output("solve lit/scene.vtu " + cells + "--texels 4 --no-facets --no-textures -o joined");
  CHECK(solutionOf(shell, "joined")["elements"] > 100);
  CHECK_FALSE(exists(shell.file("joined/scene.vtu")));
}

TEST_CASE("hemitex solve refuses a matrix of another mesh, and options that facets have no use for", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets -o F.npz");
  writeAll(shell.file("one.csv"), "0 1 1\n1 0 0\n0 0 0.5\n");
  for (const std::string& arguments : std::vector<std::string>{
           cornellBox + " --matrix F.npz", "room.obj --matrix missing.npz", "room.obj --facets --no-facets",
           "room.obj --facets --max-error 0.1 --resolution 64",
           "room.obj --facets --max-error 0.1 --orientation aligned",
           "room.obj --facets --max-error 0.1 --pixels-per-element 4", "room.obj --matrix F.npz --resolution 64",
           "room.obj --cell-emission e", "room.obj --matrix one.csv"}) {
    CAPTURE(arguments);
    const Outcome outcome = shell.run("solve " + arguments + " -o lit");
    CHECK(outcome.exitCode == 2);
    CHECK_FALSE(exists(shell.file("lit")));
  }
}

TEST_CASE("hemitex formfactors --vtu writes what the matrix says of each facet", "[cli]") {
  const Shell shell;
  shell.output("formfactors " + cornellBox + " --all --facets --max-error 0.05 -o F.npz --vtu F.vtu --row 3 --row 0");
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
  shell.output("formfactors " + cornellBox + " --all --facets --max-error 0.01 -o a.npz");
  shell.output("formfactors " + cornellBox + " --all --facets -o b.npz");
  const json table = json::parse(shell.output("matrix compare a.npz b.npz " + cornellBox + " --vtu d.vtu --json"));
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

namespace {

/// A floor that looks up, a ceiling that looks down, and a sheet of two faces between them: 0 to 3 in the order of
/// `order`, where 2 is the side of the sheet that looks down.
std::vector<std::array<glm::dvec3, 4>> sheetQuads() {
  return {{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}},
          {{{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}}},
          {{{0, 0, .5}, {0, 1, .5}, {1, 1, .5}, {1, 0, .5}}},
          {{{0, 0, .5}, {1, 0, .5}, {1, 1, .5}, {0, 1, .5}}}};
}

/// A mesh file in the format of its ending.
std::string meshText(const std::string& ending, const std::vector<std::array<glm::dvec3, 4>>& quads) {
  std::ostringstream text;
  const auto addPoints = [&](const std::string& before) {
    int number = 0;
    for (const auto& quad : quads)
      for (const glm::dvec3& p : quad) {
        text << before;
        if (ending == "vs3") text << ' ' << ++number;
        text << ' ' << p.x << ' ' << p.y << ' ' << p.z << "\n";
      }
  };
  const auto addFaces = [&](const std::string& before, int first) {
    for (std::size_t q = 0; q < quads.size(); ++q) {
      text << before;
      if (ending == "vs3") text << ' ' << q + 1;
      for (int k = 0; k < 4; ++k) text << ' ' << first + 4 * static_cast<int>(q) + k;
      text << (ending == "vs3" ? " 0 0 0.5 s" : "") << "\n";
    }
  };
  if (ending == "obj") {
    addPoints("v");
    addFaces("f", 1);
  } else if (ending == "ply") {
    text << "ply\nformat ascii 1.0\nelement vertex " << 4 * quads.size()
         << "\nproperty double x\nproperty double y\nproperty double z\nelement face " << quads.size()
         << "\nproperty list uchar int vertex_indices\nend_header\n";
    addPoints("");
    addFaces("4", 0);
  } else if (ending == "vtk") {
    text << "# vtk DataFile Version 3.0\nsheet\nASCII\nDATASET POLYDATA\nPOINTS " << 4 * quads.size() << " double\n";
    addPoints("");
    text << "POLYGONS " << quads.size() << ' ' << 5 * quads.size() << "\n";
    addFaces("4", 0);
  } else {
    text << "T sheet\nF 3\n";
    addPoints("V");
    addFaces("S", 1);
    text << "End of data\n";
  }
  return text.str();
}

}  // namespace

// Two equal squares, half of their side apart (Howell, C-11).
TEST_CASE("A pair of coincident facets is a sheet of two sides in every mesh format and order", "[cli]") {
  const Shell shell;
  const std::vector<std::array<glm::dvec3, 4>> quads = sheetQuads();
  for (const std::string ending : {"obj", "ply", "vtk", "vs3"})
    for (const std::array<std::size_t, 4>& order :
         {std::array<std::size_t, 4>{0, 1, 2, 3}, {3, 2, 1, 0}, {2, 0, 3, 1}}) {
      INFO(ending << ' ' << order[0] << order[1] << order[2] << order[3]);
      std::vector<std::array<glm::dvec3, 4>> ordered;
      for (const std::size_t q : order) ordered.push_back(quads[q]);
      writeAll(shell.file("sheet." + ending), meshText(ending, ordered));
      shell.output("formfactors sheet." + ending + " --all --facets --max-error 0.01 -o F.csv");
      const reference::SparseMatrix matrix = reference::readMatrix(shell.file("F.csv")).matrix;
      const auto factor = [&](std::size_t from, std::size_t to) {
        const auto at = [&](std::size_t q) {
          return static_cast<std::uint32_t>(std::find(order.begin(), order.end(), q) - order.begin());
        };
        const auto place = matrix.placeOf(at(from), at(to));
        return place ? matrix.value[*place] : 0;
      };
      CHECK(factor(0, 2) == Approx(0.415253).margin(0.005));
      CHECK(factor(1, 3) == Approx(0.415253).margin(0.005));
      CHECK(factor(0, 1) + factor(0, 3) + factor(2, 3) + factor(3, 2) == 0);
      CHECK(shell.run("matrix check F.csv sheet." + ending).exitCode == 0);
    }
}

TEST_CASE("Facets with two sides have their backs as rows and columns after those of the fronts", "[cli]") {
  const Shell shell;
  std::vector<std::array<glm::dvec3, 4>> quads = sheetQuads();
  quads.pop_back();                     // the sheet has one face, which looks down
  std::swap(quads[0][1], quads[0][3]);  // the floor looks down, too
  writeAll(shell.file("sheet.ply"), meshText("ply", quads));
  shell.output("formfactors sheet.ply --all --two-sided -o F.csv --vtu F.vtu --row 1");
  const reference::SparseMatrix matrix = reference::readMatrix(shell.file("F.csv")).matrix;
  REQUIRE(matrix.rows() == 6);
  const auto factor = [&](std::uint32_t from, std::uint32_t to) {
    const auto place = matrix.placeOf(from, to);
    return place ? matrix.value[*place] : 0;
  };
  CHECK(factor(3, 2) == Approx(0.415253).margin(0.005));  // from the upper side of the floor
  CHECK(factor(1, 5) == Approx(0.415253).margin(0.005));  // from the ceiling to the upper side of the sheet
  CHECK(factor(0, 1) + factor(0, 2) + factor(4, 5) == 0);
  CHECK(cellData(shell, "F.vtu", "form_factor_from_1").size() == 6);
  CHECK(shell.run("matrix check F.csv sheet.ply --two-sided").exitCode == 0);
  shell.output(
      "solve sheet.ply --facets --two-sided --emit 1=9,9,9 --max-error 0.01 --no-textures --size 40x30 -o lit");
  const std::vector<glm::dvec3> lit = vectorsOf(shell, "lit/scene.vtu", "radiosity");
  REQUIRE(lit.size() == 6);
  // Light goes forth and back.
  CHECK(lit[5].x == Approx(0.5 * 9 * 0.415253 / (1 - 0.5 * 0.5 * 0.415253 * 0.415253)).epsilon(0.01));
  CHECK(lit[2].x == 0);
}
