/// `hemitex formfactors`: which share of the light that leaves a surface reaches which element, as CSV or JSON.
///
/// A surface shoots from its patches, so its row is the mean of its patches' rows, weighted by their areas. Shares are
/// integers and add up exactly within a row; only the mean over patches is taken in binary64, in the patches' order.
#include <iostream>
#include <memory>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/json.h"
#include "cli/surface_names.h"
#include "cli/table.h"
#include "radiosity/hemicube.h"
#include "raster/input_error.h"
#include "raster/software_renderer.h"

namespace hemitex::cli {
namespace {

struct FormFactorOptions {
  SceneOptions scene;
  radiosity::DiscretizationSettings discretization;
  WordOptions word;
  std::string method = "hemicube";
  int resolution = 256;
  std::string from;
  bool bySurface = false;
  bool all = false;
};

/// What the columns of the output stand for: elements, or families of surfaces.
struct Receivers {
  std::vector<std::uint32_t> ofElement;  ///< the receiver that each element belongs to
  std::vector<double> area;              ///< one a receiver
};

Receivers elementsAsReceivers(const radiosity::Discretization& discretization) {
  Receivers receivers{std::vector<std::uint32_t>(discretization.elements.size()), {}};
  std::iota(receivers.ofElement.begin(), receivers.ofElement.end(), 0U);
  for (const radiosity::Element& element : discretization.elements) receivers.area.push_back(element.area);
  return receivers;
}

Receivers familiesAsReceivers(const radiosity::Discretization& discretization, const Families& families) {
  Receivers receivers{{}, std::vector<double>(families.names.size(), 0.0)};
  for (const radiosity::Element& element : discretization.elements) {
    receivers.ofElement.push_back(families.ofSurface[element.surface]);
    receivers.area[receivers.ofElement.back()] += element.area;
  }
  return receivers;
}

/// The mean of rows of form factors.
struct MeanRow {
  std::vector<double> formFactor;  ///< one a receiver
  double background = 0;           ///< left the scene
  double back = 0;                 ///< absorbed by the backs of surfaces
};

void addRow(MeanRow& mean, const radiosity::FormFactorRow& row, const Receivers& receivers, double weight) {
  std::vector<std::uint64_t> share(receivers.area.size(), 0);
  for (std::size_t i = 0; i < row.elements.size(); ++i) share[receivers.ofElement[row.elements[i]]] += row.shares[i];
  for (std::size_t r = 0; r < share.size(); ++r) mean.formFactor[r] += weight * radiosity::formFactor(share[r]);
  mean.background += weight * radiosity::formFactor(row.background);
  mean.back += weight * radiosity::formFactor(row.back);
}

double patchArea(const radiosity::Discretization& discretization, std::uint32_t patch) {
  const radiosity::Patch& block = discretization.patches[patch];
  double area = 0;
  for (std::uint32_t i = 0; i < block.elementCount; ++i)
    area += discretization.elements[discretization.patchElements[block.firstElement + i]].area;
  return area;
}

/// The row of one element, from its centre, or of whole surfaces, averaged over their patches.
MeanRow meanRow(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                radiosity::HemicubeRows& rows, const Source& source, const Receivers& receivers) {
  MeanRow mean{std::vector<double>(receivers.area.size(), 0.0)};
  if (source.element) {
    const auto centre = radiosity::elementCentre(scene, discretization, *source.element);
    addRow(mean, rows.from(source.surfaces.front(), centre), receivers, 1.0);
    return mean;
  }
  std::vector<std::uint32_t> patches;
  for (const std::uint32_t surface : source.surfaces) {
    const radiosity::Grid& grid = discretization.grids[surface];
    for (std::uint32_t p = 0; p < grid.patchCount; ++p) patches.push_back(grid.firstPatch + p);
  }
  double area = 0;
  for (const std::uint32_t patch : patches) area += patchArea(discretization, patch);
  for (const std::uint32_t patch : patches)
    addRow(mean, rows.ofPatch(patch), receivers, patchArea(discretization, patch) / area);
  return mean;
}

/// A table of form factors, one row a receiver: element by element, or family by family.
Table tableOf(const radiosity::Scene& scene, const radiosity::Discretization& discretization, const MeanRow& mean) {
  const auto row = [&](std::size_t index) -> std::vector<Cell> {
    const radiosity::Element& element = discretization.elements[index];
    const auto columns = static_cast<std::uint32_t>(discretization.grids[element.surface].columns);
    return {scene.surfaces[element.surface].name, std::int64_t{element.texel % columns},
            std::int64_t{element.texel / columns}, element.area, mean.formFactor[index]};
  };
  return {{"surface", "column", "row", "area", "form_factor"}, discretization.elements.size(), row};
}

Table tableOf(const Families& families, const Receivers& receivers, const MeanRow& mean) {
  const auto row = [&](std::size_t index) -> std::vector<Cell> {
    return {families.names[index], receivers.area[index], mean.formFactor[index]};
  };
  return {{"surface", "area", "form_factor"}, families.names.size(), row};
}

void printRow(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
              const radiosity::Discretization& discretization, radiosity::HemicubeRows& rows) {
  const Source source = sourceNamed(scene, discretization, options.from);
  const Families families = familiesOf(scene);
  const Receivers receivers =
      options.bySurface ? familiesAsReceivers(discretization, families) : elementsAsReceivers(discretization);
  const MeanRow mean = meanRow(scene, discretization, rows, source, receivers);
  context.console.message("from " + options.from + ": " + toText(mean.background) + " leaves the scene, " +
                          toText(mean.back) + " meets backs of faces");
  const Table table = options.bySurface ? tableOf(families, receivers, mean) : tableOf(scene, discretization, mean);
  if (!context.json) return writeCsv(std::cout, table);
  std::cout << toText({{"from", options.from},
                       {"method", options.method},
                       {"resolution", options.resolution},
                       {"row", toJson(table)},
                       {"background", mean.background},
                       {"back", mean.back}});
}

void printMatrix(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
                 const radiosity::Discretization& discretization, radiosity::HemicubeRows& rows) {
  const Families families = familiesOf(scene);
  const Receivers receivers = familiesAsReceivers(discretization, families);
  const std::size_t count = families.names.size();
  std::vector<MeanRow> matrix;
  for (std::size_t from = 0; from < count; ++from) {
    context.console.progress(static_cast<double>(from) / static_cast<double>(count), families.names[from]);
    matrix.push_back(meanRow(scene, discretization, rows, {families.surfaces[from]}, receivers));
  }
  context.console.endProgress();
  const auto row = [&](std::size_t index) -> std::vector<Cell> {
    return {families.names[index / count], families.names[index % count],
            matrix[index / count].formFactor[index % count]};
  };
  const Table table{{"from", "to", "form_factor"}, count * count, row};
  if (!context.json) return writeCsv(std::cout, table);
  std::cout << toText({{"method", options.method}, {"resolution", options.resolution}, {"matrix", toJson(table)}});
}

void print(const FormFactorOptions& options, Context& context) {
  const radiosity::Scene scene = sceneOf(options.scene, context.console);
  const radiosity::Discretization discretization = discretizationOf(options.discretization, scene);
  const radiosity::WordLayout layout = layoutOf(options.word, discretization, context.console);
  raster::SoftwareRenderer renderer(radiosity::makeDrawList(scene, discretization, layout));
  radiosity::HemicubeRows rows(scene, discretization, layout, renderer, options.resolution);
  (options.all ? printMatrix : printRow)(options, context, scene, discretization, rows);
}

}  // namespace

void addFormFactors(CLI::App& program, Context& context) {
  const auto options = std::make_shared<FormFactorOptions>();
  CLI::App* command = program.add_subcommand("formfactors", "Form factors from a surface, as CSV");
  addSceneOptions(*command, options->scene);
  CLI::Option* from =
      command->add_option("--from", options->from, "where the light leaves")->type_name("SURFACE[:COL,ROW]");
  CLI::Option* bySurface = command->add_flag("--by-surface", options->bySurface, "add up the elements of a surface");
  CLI::Option* all = command->add_flag("--all", options->all, "from every surface to every surface");
  all->needs(bySurface)->excludes(from);
  addChoice<std::string>(*command, "--method", options->method, {{"hemicube", "hemicube"}}, "how they are found");
  addResolution(*command, options->resolution);
  addDiscretizationOptions(*command, options->discretization);
  addWordOptions(*command, options->word);
  command->callback([options, &context] {
    if (options->from.empty() && !options->all) throw CLI::RequiredError("--from, or --all --by-surface,");
    context.command = [options, &context] { print(*options, context); };
  });
}

}  // namespace hemitex::cli
