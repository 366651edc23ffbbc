/// `hemitex matrix`: judges, compares and repairs matrices of form factors that any program computed for a mesh.
#include <algorithm>
#include <cmath>
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/staging.h"
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
#include "reference/matrices/matrix_rows.h"
#include "reference/matrices/smoothing.h"
#include "reference/rows/scene_rows.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

struct MatrixOptions {
  fs::path matrix, other;
  fs::path vtu;  ///< of the differences; empty: none
  fs::path output;
  double drop = 0;  ///< form factors below are dropped
  bool isBalanced = false;
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
  if (verdict.fault)
    std::cout << "fault: " << *verdict.fault << '\n';
  else if (!verdict.problems.empty())
    std::cout << "no known fault explains this\n";
  if (verdict.measuredRows > 0)
    std::cout << verdict.measuredRows << " rows differ from rays by " << percentText(verdict.difference)
              << " of their light, of which the rays explain " << percentText(verdict.noise)
              << "; reciprocity is missed by " << percentText(verdict.reciprocity) << '\n';
  if (verdict.problems.empty()) std::cout << "nothing wrong was found\n";
}

void requireRows(const fs::path& file, const reference::SparseMatrix& matrix, std::size_t facets) {
  if (matrix.rows() == facets && (matrix.columns == facets || matrix.columns == facets + 2)) return;
  throw raster::InputError(file.string(), 0,
                           "has " + std::to_string(matrix.rows()) + " rows and " + std::to_string(matrix.columns) +
                               " columns, and the mesh has " + std::to_string(facets) + " facets",
                           "give a matrix of this mesh");
}

void compare(const MatrixOptions& options, Context& context) {
  const reference::SparseMatrix a = reference::readMatrix(options.matrix).matrix,
                                b = reference::readMatrix(options.other).matrix;
  const Mesh mesh = meshOf(options.mesh, context.console);
  const std::size_t facets = mesh.facets.names.size();
  requireRows(options.matrix, a, facets);
  requireRows(options.other, b, facets);
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

/// Whether facets see nothing outside of the mesh: those of closed rooms, and all if the largest shell is a room.
std::vector<bool> enclosedFacets(const Mesh& mesh) {
  const std::vector<double>& volumes = mesh.scene.shellVolumes;
  const auto largest =
      std::max_element(volumes.begin(), volumes.end(), [](double a, double b) { return std::abs(a) < std::abs(b); });
  const bool isAll = largest != volumes.end() && *largest < 0;
  std::vector<bool> enclosed(mesh.facets.names.size(), isAll);
  for (std::size_t s = 0; s < mesh.scene.surfaces.size() && !isAll; ++s) {
    const std::int32_t shell = mesh.scene.surfaces[s].triangles.front().shell;
    enclosed[mesh.facets.ofSurface[s]] = shell > 0 && volumes[static_cast<std::size_t>(shell) - 1] < 0;
  }
  return enclosed;
}

/// A row that is prepared for smoothing, and the share that it gave to surroundings that an enclosed facet cannot see.
struct PreparedRow {
  reference::SparseRow row;
  double leak = 0;
};

/// Leaves out factors below `drop` and those of facets without area. A row of a square matrix gets what is missing to 1
/// as surroundings, and an enclosed one no surroundings. A balanced row is scaled so that it sums to 1.
PreparedRow preparedRow(const reference::SparseRow& given, bool isSquare, bool isEnclosed,
                        const std::vector<double>& area, const MatrixOptions& options) {
  PreparedRow result;
  const std::size_t facets = area.size();
  double toFacets = 0, all = 0, outside = 0;
  const auto append = [&](std::size_t column, double value, double error) {
    result.row.column.push_back(static_cast<std::uint32_t>(column));
    result.row.value.push_back(value);
    if (!given.error.empty()) result.row.error.push_back(error);
  };
  for (std::size_t k = 0; k < given.column.size(); ++k) {
    const std::size_t column = given.column[k];
    const double value = std::max(given.value[k], 0.0);
    all += value;
    if (column < facets ? area[column] == 0 || value < options.drop : column == facets && isEnclosed) {
      if (column == facets) result.leak = value;
      continue;
    }
    (column < facets ? toFacets : outside) += value;
    append(column, value, given.error.empty() ? 0 : given.error[k]);
  }
  if (isSquare && !isEnclosed && all < 1) {
    outside = 1 - all;
    append(facets, outside, 0);
  }
  if (options.isBalanced && toFacets > 0 && outside < 1)
    for (std::size_t k = 0; k < result.row.column.size() && result.row.column[k] < facets; ++k)
      result.row.value[k] *= (1 - outside) / toFacets;
  return result;
}

void smooth(const MatrixOptions& options, Context& context) {
  const reference::SparseMatrix matrix = reference::readMatrix(options.matrix).matrix;
  const Mesh mesh = meshOf(options.mesh, context.console);
  const std::size_t facets = mesh.facets.names.size();
  requireRows(options.matrix, matrix, facets);
  Staging staging(Output{Output::Kind::File, options.output, "matrix smooth", context.inputs(mesh.scene.files)});
  staging.requirePlaces({options.output.filename()});
  if (!reference::isMatrixFile(options.output))
    throw raster::InputError(options.output.string(), 0, "matrices are not written in this format",
                             "choose a name that ends in .npz, .mtx or .csv");
  reference::MatrixHeading heading{reference::familiesAsReceivers(mesh.discretization, mesh.facets).area};
  heading.hasErrors = !matrix.error.empty();
  const std::unique_ptr<reference::RowSink> sink = reference::matrixSink(staging.file(), heading);
  constexpr double smallestLeak = 1e-6;
  const std::vector<bool> isEnclosed = enclosedFacets(mesh);
  reference::MatrixSmoother smoother(heading.area, reference::maxStandardErrors);
  ordered_json leaks = ordered_json::array();
  for (std::size_t f = 0; f < facets; ++f) {
    const reference::SparseRow given = heading.area[f] > 0 ? matrix.row(f) : reference::SparseRow();
    const PreparedRow prepared = preparedRow(given, matrix.columns == facets, isEnclosed[f], heading.area, options);
    if (prepared.leak > smallestLeak) leaks.push_back({{"facet", f}, {"surroundings", prepared.leak}});
    smoother.add(heading.area[f] > 0 ? prepared.row : reference::SparseRow());
  }
  const reference::SmoothingMoves moves = smoother.smooth(true);
  smoother.forEachRow([&](const reference::SparseRow& row) { sink->write(row); });
  sink->finish();
  staging.commit();
  if (context.json) {
    std::cout << toText({{"largest", moves.largest},
                         {"root_mean_square", moves.rootMeanSquare},
                         {"rows_missed", moves.missed},
                         {"leaks", leaks}});
    return;
  }
  for (const ordered_json& leak : leaks)
    std::cout << "leak: facet " << leak["facet"] << " gave " << roundedText(leak["surroundings"])
              << " to the surroundings of a closed mesh\n";
  std::cout << "form factors moved by at most " << roundedText(moves.largest) << ", root mean square "
            << roundedText(moves.rootMeanSquare) << '\n';
  if (!moves.missed.empty())
    context.console.warning(std::to_string(moves.missed.size()) +
                            " rows do not sum to 1: others have no more to give, or their errors allow no more");
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
  const Command matrix = program.addCommand("matrix", "Judge and repair form-factor matrices of other programs");
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
  const Command smoothing = matrix.addCommand(
      "smooth", "Repair a matrix: reciprocity and rows that sum to 1, with the smallest change; surroundings stay");
  smoothing.addPath("FILE", options->matrix, "matrix: .npz, .mtx, .csv, .vf or .txt").required();
  addMesh(smoothing, *options);
  smoothing.addOutputFile("-o,--output", options->output, "write the repaired matrix: .npz, .mtx or .csv", "FILE")
      .required();
  addPositive(smoothing, "--drop", options->drop, 1, "leave out form factors below X first (default: none)");
  smoothing.addFlag("--balance", options->isBalanced, "first scale the form factors of each row so that it sums to 1");
  smoothing.addExamples({"factors.vf room.vs3 -o F.npz", "F.npz city.stl --drop 1e-6 --balance -o smooth.npz"});
  smoothing.onRead([options, &context] { context.command = [options, &context] { smooth(*options, context); }; });
  matrix.addExamples({"check F.npz city.stl", "compare F.npz factors.vf city.vs3"});
  comparing.onRead([options, &context] { context.command = [options, &context] { compare(*options, context); }; });
}

}  // namespace hemitex::cli
