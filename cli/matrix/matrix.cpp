/// `hemitex matrix`: judges and compares matrices of form factors that any program computed for a mesh.
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/table.h"
#include "cli/scene/facet_file.h"
#include "cli/scene/scene_options.h"
#include "cli/scene/symmetry_options.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/mesh_sections.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"
#include "reference/matrices/matrix_difference.h"
#include "reference/matrices/matrix_files.h"
#include "reference/matrices/matrix_judge.h"
#include "reference/rows/scene_rows.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

struct MatrixOptions {
  fs::path matrix, other;
  fs::path vtu;  ///< of the differences; empty: none
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
  radiosity::DiscretizationSettings elements;
  chooseFacets(options.settings, elements);
  Mesh mesh{radiosity::withoutBuried(sceneOf(options, console)), {}, {}};
  mesh.discretization = radiosity::discretize(mesh.scene, elements);
  mesh.facets = radiosity::facetsOf(mesh.scene);
  return mesh;
}

/// The facets that repeat another one with area, and the other one.
std::vector<std::pair<std::uint32_t, std::uint32_t>> repeatedFacets(const SceneOptions& options,
                                                                    const radiosity::Families& facets) {
  const std::vector<std::uint32_t> first =
      radiosity::firstOfEqual(radiosity::readFaces(options.file, options.settings.sides));
  std::vector<std::pair<std::uint32_t, std::uint32_t>> repeated;
  for (std::uint32_t f = 0; f < first.size(); ++f)
    if (first[f] != f && !facets.surfaces[first[f]].empty() && facets.surfaces[f].empty())
      repeated.emplace_back(f, first[f]);
  return repeated;
}

void check(const MatrixOptions& options, Context& context) {
  const reference::MatrixFile file = reference::readMatrix(options.matrix);
  const Mesh mesh = meshOf(options.mesh, context.console);
  const reference::MatrixVerdict verdict =
      reference::judgeMatrix(file.matrix,
                             {mesh.scene, mesh.discretization, mesh.facets.ofSurface, mesh.facets.names.size(),
                              repeatedFacets(options.mesh, mesh.facets)},
                             options.judge);
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
  const std::vector<double> area = reference::familiesAsReceivers(mesh.discretization, mesh.facets).area;
  const reference::MatrixDifference found = reference::matrixDifference(a, b, area);
  if (!options.vtu.empty())
    FacetFile(options.vtu, "matrix compare", context.inputs(mesh.scene.files))
        .write(options.mesh.file, options.mesh.settings.sides,
               std::vector<radiosity::FaceArray>{{"difference", 1, found.difference},
                                                 {"difference_received", 1, found.received},
                                                 {"row_sum", 1, found.sum}});
  const Table table{{"facet", "area", "sum", "difference"}, facets, [&](std::size_t f) -> std::vector<Cell> {
                      return {std::int64_t(f), area[f], found.sum[f], found.difference[f]};
                    }};
  if (context.json) {
    std::cout << toText({{"difference", found.share}, {"facets", toJson(table)}});
    return;
  }
  context.console.message("the matrices differ by " + percentText(found.share) + " of the exchange between facets");
  writeCsv(std::cout, table);
}

void addMesh(Command command, MatrixOptions& options) {
  command.addPath("MESH", options.mesh.file, "mesh: STL, OBJ, PLY, VTK, View3D or glTF; each face is a facet")
      .required();
  command.addFlag("--two-sided", "the rows and columns after those of the facets are those of their backs",
                  [&options] { options.mesh.settings.sides = radiosity::Sides::Two; });
  addSymmetryOptions(command, options.mesh.settings.symmetry);
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
  comparing.addOutputFile(
      "--vtu", options->vtu,
      "also write the mesh for ParaView, each facet with the difference of its rows and of the light "
      "that it receives",
      "FILE.vtu");
  comparing.addExamples({"F.npz factors.vf city.vs3", "coarse.npz fine.npz city.stl --vtu difference.vtu"});
  matrix.addExamples({"check F.npz city.stl", "compare F.npz factors.vf city.vs3"});
  comparing.onRead([options, &context] { context.command = [options, &context] { compare(*options, context); }; });
}

}  // namespace hemitex::cli
