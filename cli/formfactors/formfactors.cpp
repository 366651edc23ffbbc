/// `hemitex formfactors`: computes form factors from a surface to elements or surfaces, and prints them as CSV or JSON.
/// For the matrix of all surfaces it also prints row sums and deviations from reciprocity.
#include <memory>
#include <string>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/program.h"
#include "cli/formfactors/matrix_output.h"
#include "cli/formfactors/printed_rows.h"
#include "cli/formfactors/row_options.h"
#include "cli/scene/scene_options.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/lower_case.h"
#include "reference/matrices/matrix_files.h"

namespace hemitex::cli {
namespace {

void print(const FormFactorOptions& options, Context& context) {
  radiosity::Scene scene = sceneOf(options.scene, context.console);
  if (options.scene.settings.facets) scene = radiosity::withoutBuried(std::move(scene));
  const radiosity::Discretization discretization = discretizationOf(options.discretization, scene);
  (isSparse(options) ? writeMatrix : options.all ? printMatrix : printRows)(options, context, scene, discretization);
}

/// The file of a sparse matrix, whose rows sum to 1, has a known format.
void requireMatrixFile(const FormFactorOptions& options) {
  if (options.output.empty())
    usageError("--all", "needs --by-surface, or -o with a file that ends in .npz, .mtx or .csv");
  if (!reference::isMatrixFile(options.output))
    usageError("-o", "`" + options.output.string() + "` does not end in .npz, .mtx or .csv");
  if (options.method == "analytic" || options.rays.aimed)
    usageError("--all", "is written with methods whose rows sum to 1; --method analytic and --aimed are none");
}

/// A table of surfaces is text: one in a file named as an archive could not be read as what its name says.
void requireTableFile(const FormFactorOptions& options) {
  if (reference::isMatrixFile(options.output) && raster::endingOf(options.output) != ".csv")
    usageError("-o", "`" + options.output.string() +
                         "` would be a table of text; end its name in .csv, or write sparse rows without --by-surface");
}

/// Meshes without materials have facets, of one texel unless another size is given.
void completeFacets(FormFactorOptions& options) {
  if (options.facets || (radiosity::isPlainMesh(options.scene.file) && !options.bySurface))
    chooseFacets(options.scene.settings, options.discretization);
}

}  // namespace

void addFormFactors(Command program, Context& context) {
  const auto options = std::make_shared<FormFactorOptions>();
  const Command command = program.addCommand("formfactors", "Compute form factors from a surface to all others");
  const Command rows = command.under("Rows");
  const Option from = rows.addText("--from", "SURFACE[:COL,ROW]",
                                   "surface, or texel of a surface, that the form factors start from", options->from);
  const Option bySurface =
      rows.addFlag("--by-surface", options->bySurface, "print one sum per surface instead of one value per element");
  const Option all = rows.addFlag("--all", options->all,
                                  "the matrix from every surface to every surface: printed with --by-surface, or "
                                  "written into a file of sparse rows with -o FILE.npz, FILE.mtx or FILE.csv");
  all.excludes(from);
  rows.addTexts("--at", "x,y,z,nx,ny,nz",
                "point with a normal that the form factors start from, on a surface or not; or a CSV file of such "
                "points (repeatable). The share that leaves the scene is the sky view factor.",
                [options](const std::string& text) { options->at.push_back(text); })
      .excludes(all);
  rows.addFlag("--facets", options->facets,
               "make every face of the file a surface of one element, numbered from 0 (default for meshes without "
               "materials, such as STL and VTU, unless --by-surface is given)")
      .excludes(bySurface);
  rows.addFlag("--smooth", options->smooth,
               "correct the matrix to exact reciprocity by least squares, with the same row sums; both measurements of "
               "a pair are averaged, so that errors become smaller")
      .needs(all);
  rows.addOutputFile("-o,--output", options->output,
                     "write the matrix into this file, and with --json only its checks to stdout; rows are kept in "
                     "FILE.part, from which an interrupted run goes on")
      .needs(all);
  const Option vtu =
      rows.addOutputFile("--vtu", options->vtu,
                         "with --all -o of facets, also write the mesh for ParaView: each facet with the sum "
                         "of its row, its shares of surroundings and backs, and its estimated error if known",
                         "FILE.vtu")
          .needs(all);
  rows.addTexts("--row", "N", "also write the row of facet N into the file of --vtu (repeatable)",
                [options](const std::string& text) {
                  options->vtuRows.push_back(integerOption("--row", text, 0, std::numeric_limits<int>::max()));
                })
      .needs(vtu);
  const Command method = command.under("Form factors");
  const Option maxError = addPositive(
      method, "--max-error", options->maxError, 1,
      "with --all --facets -o, bound the error of every row, which is the sum of the absolute errors of its form "
      "factors: hemicubes tell what is hidden, closed forms tell the rest (default: by the other options)");
  method.addFlag("--insist", context.insists,
                 "exit with code 1 if the estimated error of a row is above --max-error; run with more than 2^24 "
                 "elements, or with more memory than is free (default: refuse, with the number)");
  addMethod(
      method, options->method, {"rays", "analytic"},
      "compute form factors with this projection, with rays or with closed forms (analytic), which ignore blockers "
      "(default hemicube)");
  addDrawingOptions(command, options->drawing);
  addRowDevice(command, options->device);
  addInteger(method, "--samples", options->rays.samples, 64, 1 << 28,
             "with --method rays, cast N rays per row; with --aimed, cast rays from N points (default 65536)");
  addSeed(method, options->rays.seed);
  method.addFlag(
      "--aimed", options->rays.aimed,
      "with --method rays, aim at each receiver instead of covering the hemisphere; accurate, but slow for many "
      "receivers");
  addDiscretizationOptions(command, options->discretization);
  addIdOptions(command, options->id);
  addSceneOptions(command, options->scene);
  for (const char* chosen : {"--split", "--method", "--samples", "--texels", "--texel-size", "--surface", "--patch"})
    maxError.excludes(command.option(chosen));
  for (const std::string& drawn : drawingOptionNames()) maxError.excludes(command.option(drawn));
  command.showFirst({"--from", "--by-surface", "--all", "--facets", "--smooth", "--method", "--resolution", "--samples",
                     "--texels", "--patch"});
  command.addExamples(
      {"data/cornell-box.obj --from light --by-surface", "data/cornell-box.obj --all --facets -o F.npz"});
  command.onRead([options, command, &context] {
    context.isShared = options->all;
    if (options->from.empty() && options->at.empty() && !options->all)
      usageError("--from", "is required; or give points with --at, or print the matrix with --all --by-surface");
    if (!options->at.empty() && !projectionNamed(options->method))
      usageError("--at", "needs a --method that draws: hemicube, single-plane or tetrahedron");
    if (options->all) (options->bySurface ? requireTableFile : requireMatrixFile)(*options);
    completeFacets(*options);
    if (options->maxError && !(isSparse(*options) && options->scene.settings.facets))
      usageError("--max-error", "bounds the rows of a matrix of facets; add --all --facets -o FILE.npz");
    if (!options->vtu.empty() && !(isSparse(*options) && options->scene.settings.facets))
      usageError("--vtu", "shows the matrix of facets; add --all --facets -o FILE.npz");
    const auto projection = projectionNamed(options->method);
    if (projection) options->drawing.projection = *projection;
    if (!projection) refuseUnused(command, drawingOptionNames(), options->method);
    if (!projection) refuseUnused(command, {"--split"}, options->method);
    if (options->method != "rays") refuseUnused(command, {"--samples", "--seed", "--aimed"}, options->method);
    context.command = [options, &context] { print(*options, context); };
  });
}

}  // namespace hemitex::cli
