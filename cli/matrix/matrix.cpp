/// `hemitex matrix`: judges and compares matrices of form factors that any program computed for a mesh.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/table.h"
#include "cli/scene/scene_options.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"
#include "reference/truth/matrices/matrix_files.h"
#include "reference/truth/matrices/matrix_judge.h"
#include "reference/truth/rows/scene_rows.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

struct MatrixOptions {
  fs::path matrix, other;
  SceneOptions mesh;
  reference::JudgeSettings judge;
};

/// The mesh of a matrix, of which each face is a facet.
struct Mesh {
  radiosity::Scene scene;
  radiosity::Discretization discretization;
  radiosity::Families facets;
};

Mesh meshOf(SceneOptions options, Console& console) {
  radiosity::DiscretizationSettings elements{.texels = 1};
  chooseFacets(options.settings, elements);
  Mesh mesh{sceneOf(options, console), {}, {}};
  mesh.discretization = radiosity::discretize(mesh.scene, elements);
  mesh.facets = radiosity::facetsOf(mesh.scene);
  return mesh;
}

void check(const MatrixOptions& options, Context& context) {
  const reference::MatrixFile file = reference::readMatrix(options.matrix);
  const Mesh mesh = meshOf(options.mesh, context.console);
  const reference::MatrixVerdict verdict = reference::judgeMatrix(
      file.matrix, {mesh.scene, mesh.discretization, mesh.facets.ofSurface, mesh.facets.names.size()}, options.judge);
  context.failed = !verdict.problems.empty();
  if (context.json) {
    std::cout << toText({{"problems", verdict.problems},
                         {"fault", verdict.fault ? ordered_json(*verdict.fault) : ordered_json()},
                         {"largest_row_sum", verdict.largestRowSum},
                         {"reciprocity", verdict.reciprocity},
                         {"difference", verdict.difference},
                         {"noise", verdict.noise},
                         {"measured_rows", verdict.measuredRows}});
    return;
  }
  for (const std::string& problem : verdict.problems) std::cout << "wrong: " << problem << '\n';
  if (verdict.fault) std::cout << "fault: " << *verdict.fault << '\n';
  if (verdict.measuredRows > 0)
    std::cout << verdict.measuredRows << " rows differ from rays by " << percentText(verdict.difference)
              << " of their light, of which the rays explain " << percentText(verdict.noise)
              << "; reciprocity is missed by " << percentText(verdict.reciprocity) << '\n';
  if (verdict.problems.empty()) std::cout << "nothing wrong was found\n";
}

/// The light that a facet sends elsewhere in another matrix.
struct Difference {
  std::size_t facet = 0;
  double sum = 0, difference = 0;
};

Difference differenceOf(std::size_t facet, const reference::SparseRow& a, const reference::SparseRow& b,
                        std::uint32_t facets) {
  Difference result{facet, 0, 0};
  std::size_t i = 0, k = 0;
  const auto isLeft = [&](const reference::SparseRow& row, std::size_t at) {
    return at < row.column.size() && row.column[at] < facets;
  };
  while (isLeft(a, i) || isLeft(b, k)) {
    const std::uint32_t column = std::min(isLeft(a, i) ? a.column[i] : facets, isLeft(b, k) ? b.column[k] : facets);
    const double x = isLeft(a, i) && a.column[i] == column ? a.value[i++] : 0,
                 y = isLeft(b, k) && b.column[k] == column ? b.value[k++] : 0;
    result.sum += x;
    result.difference += std::abs(x - y);
  }
  return result;
}

void compare(const MatrixOptions& options, Context& context) {
  const reference::SparseMatrix a = reference::readMatrix(options.matrix).matrix,
                                b = reference::readMatrix(options.other).matrix;
  const Mesh mesh = meshOf(options.mesh, context.console);
  const std::size_t facets = mesh.facets.names.size();
  for (const auto& [file, matrix] : {std::pair(&options.matrix, &a), std::pair(&options.other, &b)})
    if (matrix->rows() != facets)
      throw raster::InputError(
          file->string(), 0,
          "has " + std::to_string(matrix->rows()) + " rows, and the mesh has " + std::to_string(facets) + " facets",
          "give matrices of this mesh");
  const std::vector<double> area = reference::familiesAsReceivers(mesh.scene, mesh.discretization, mesh.facets).area;
  std::vector<Difference> differences;
  double all = 0, apart = 0;
  for (std::size_t f = 0; f < facets; ++f) {
    differences.push_back(differenceOf(f, a.row(f), b.row(f), static_cast<std::uint32_t>(facets)));
    all += area[f] * differences[f].sum;
    apart += area[f] * differences[f].difference;
  }
  const double share = all > 0 ? apart / all : 0;
  const Table table{{"facet", "area", "sum", "difference"}, facets, [&](std::size_t f) -> std::vector<Cell> {
                      return {std::int64_t(f), area[f], differences[f].sum, differences[f].difference};
                    }};
  if (context.json) {
    std::cout << toText({{"difference", share}, {"facets", toJson(table)}});
    return;
  }
  context.console.message("the matrices differ by " + percentText(share) + " of the exchange between facets");
  writeCsv(std::cout, table);
}

void addMesh(Command command, MatrixOptions& options) {
  command.addPath("MESH", options.mesh.file, "mesh: STL, OBJ, PLY, VTK, View3D or glTF; each face is a facet")
      .required();
}

}  // namespace

void addMatrix(Command program, Context& context) {
  const Command matrix = program.addCommand("matrix", "Judge form-factor matrices of other programs");
  const auto options = std::make_shared<MatrixOptions>();
  const Command checking = matrix.addCommand(
      "check", "Say what is wrong with a matrix, where, and which fault explains it (exit code 1 if something is)");
  checking.addPath("FILE", options->matrix, "matrix: .npz, .mtx, .csv, .vf or .txt").required();
  addMesh(checking, *options);
  addPositive(checking, "--tolerance", options->judge.tolerance, 10,
              "relative error of an entry that is no fault (default 0.05)");
  addInteger(checking, "--rows", options->judge.rows, 1, 1 << 20, "measure N rows by rays (default 32)");
  addInteger(checking, "--samples", options->judge.samples, 64, 1 << 26,
             "cast N rays per measured row (default 262144)");
  checking.addExamples({"F.npz city.stl", "factors.vf room.vs3 --tolerance 0.01"});
  checking.onRead([options, &context] { context.command = [options, &context] { check(*options, context); }; });
  const Command comparing =
      matrix.addCommand("compare", "Print how far two matrices are apart, facet by facet, as CSV");
  comparing.addPath("FILE", options->matrix, "matrix: .npz, .mtx, .csv, .vf or .txt").required();
  comparing.addPath("OTHER", options->other, "another matrix of the same mesh").required();
  addMesh(comparing, *options);
  comparing.addExamples({"F.npz factors.vf city.vs3", "coarse.npz fine.npz city.stl --json"});
  matrix.addExamples({"check F.npz city.stl", "compare F.npz factors.vf city.vs3"});
  comparing.onRead([options, &context] { context.command = [options, &context] { compare(*options, context); }; });
}

}  // namespace hemitex::cli
