/// `hemitex formfactors`: computes form factors from a surface to elements or surfaces, and prints them as CSV or JSON.
/// For the matrix of all surfaces it also prints row sums and deviations from reciprocity.
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/program.h"
#include "cli/common/table.h"
#include "cli/formfactors/facet_values.h"
#include "cli/formfactors/row_file.h"
#include "cli/scene/facet_file.h"
#include "cli/scene/scene_hash.h"
#include "cli/scene/scene_options.h"
#include "cli/scene/source_names.h"
#include "cli/scene/symmetry_options.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/ranks/shared_tasks.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/file_io.h"
#include "reference/base/hashes/sha256.h"
#include "reference/matrices/matrix_files.h"
#include "reference/matrices/npz_file.h"
#include "reference/matrices/smoothing.h"
#include "reference/rows/scene_rows.h"
#include "reference/truth/solution/form_factor_matrix.h"

namespace hemitex::cli {
namespace {

using radiosity::Families;
using reference::OutsideShares;
using reference::RowMethod;
using reference::RowReceivers;
using reference::SparseRow;

struct FormFactorOptions {
  SceneOptions scene;
  radiosity::DiscretizationSettings discretization;
  radiosity::IdSettings id;
  std::string method = "hemicube";
  radiosity::DrawingSettings drawing;
  reference::RayOptions rays;
  std::string from;
  std::vector<std::string> at;  ///< points or files of points
  bool bySurface = false;
  bool all = false;
  bool smooth = false;
  bool facets = false;
  std::optional<double> maxError;
  std::filesystem::path output;  ///< empty: standard output
  std::filesystem::path vtu;     ///< of the facets; empty: none
  std::vector<int> vtuRows;      ///< facets whose rows are in that file
};

/// Whether the result is a file with a sparse matrix.
bool isSparse(const FormFactorOptions& options) { return options.all && !options.output.empty() && !options.bySurface; }

const std::string blockersIgnored = "blockers are not looked at";

RowMethod methodOf(const FormFactorOptions& options, const radiosity::Scene& scene,
                   const radiosity::Discretization& discretization, const RowReceivers& receivers, Context& context) {
  if (options.maxError) return reference::facetMethod(scene, receivers, *options.maxError, context.ranks ? 1 : 256);
  if (options.method == "rays") return reference::rayMethod(scene, discretization, receivers, options.rays);
  if (options.method == "analytic") return reference::analyticMethod(scene, discretization, receivers);
  return reference::drawnMethod(scene, discretization, receivers, layoutOf(options.id, discretization),
                                options.drawing);
}

/// The settings of the method that the JSON output repeats.
nlohmann::ordered_json methodSettings(const FormFactorOptions& options) {
  if (options.method == "rays")
    return {{"method", options.method},
            {"samples", options.rays.samples},
            {"seed", options.rays.seed},
            {"aimed", options.rays.aimed}};
  if (options.method == "analytic") return {{"method", options.method}, {"blockers_ignored", true}};
  if (options.maxError) return {{"method", options.method}, {"max_error", *options.maxError}};
  nlohmann::ordered_json settings{{"method", options.method}};
  settings.update(toJson(options.drawing));
  return settings;
}

/// The settings that the JSON output repeats.
nlohmann::ordered_json settingsOf(const FormFactorOptions& options) {
  nlohmann::ordered_json settings = methodSettings(options);
  if (const auto& symmetry = options.scene.settings.symmetry; !symmetry.isNone())
    settings["symmetry"] = toJson(symmetry);
  return settings;
}

/// A table with one line per row and receiver: cells that name them, the form factor, and its standard error if there
/// is one.
Table tableOf(const std::vector<SparseRow>& rows, std::size_t receivers, std::vector<std::string> columns,
              const std::function<std::vector<Cell>(std::size_t)>& names) {
  const bool hasErrors = !rows.front().error.empty();
  columns.emplace_back("form_factor");
  if (hasErrors) columns.emplace_back("standard_error");
  const auto cells = [&rows, names, receivers, hasErrors](std::size_t index) {
    const SparseRow& row = rows[index / receivers];
    const std::optional<std::size_t> entry = row.placeOf(index % receivers);
    std::vector<Cell> line = names(index);
    line.emplace_back(entry ? row.value[*entry] : 0.0);
    if (hasErrors) line.emplace_back(entry ? row.error[*entry] : 0.0);
    return line;
  };
  return {columns, rows.size() * receivers, cells};
}

/// A source and how it was named.
struct NamedSource {
  std::string name;
  reference::Source source;
};

std::vector<NamedSource> sourcesOf(const FormFactorOptions& options, const radiosity::Scene& scene,
                                   const radiosity::Discretization& discretization) {
  if (options.at.empty()) return {{options.from, sourceNamed(scene, discretization, options.from)}};
  std::vector<NamedSource> sources;
  for (const std::string& text : options.at)
    for (const NamedPoint& point : pointsNamed(text)) sources.push_back({point.name, {.point = point.point}});
  return sources;
}

/// The table of one row, or of the rows of several points, which are counted from 1.
Table tableOf(const std::vector<SparseRow>& rows, const radiosity::Scene& scene,
              const radiosity::Discretization& discretization, const Families& families,
              const RowReceivers& receivers) {
  const std::size_t count = receivers.area.size();
  const bool areElements = receivers.ofSurface.empty();
  std::vector<std::string> columns{"surface", "area"};
  if (areElements) columns.insert(columns.begin() + 1, {"column", "row"});
  if (rows.size() > 1) columns.insert(columns.begin(), "point");
  return tableOf(rows, count, columns, [&, areElements, count](std::size_t index) {
    std::vector<Cell> cells;
    if (rows.size() > 1) cells.emplace_back(static_cast<std::int64_t>(index / count) + 1);
    index %= count;
    if (areElements) {
      const radiosity::Element& element = discretization.elements[index];
      const auto width = static_cast<std::uint32_t>(discretization.grids[element.surface].columns);
      cells.insert(cells.end(), {scene.surfaces[element.surface].name, std::int64_t{element.texel % width},
                                 std::int64_t{element.texel / width}});
    } else {
      cells.emplace_back(families.names[index]);
    }
    cells.emplace_back(receivers.area[index]);
    return cells;
  });
}

void tellCaptured(const RowMethod& method, Console& console) {
  if (method.captured && *method.captured < 1)
    console.message("the projection captures " + percentText(*method.captured) +
                    " of the light; the rest counts as leaving the scene");
}

/// Warns of rows of which backs take more than 1 %: faces may be turned over. `backs` has the share of each row.
void warnOfBacks(const std::vector<double>& backs, const std::vector<std::string>& names, Console& console) {
  constexpr double limit = 0.01;
  const auto most = std::max_element(backs.begin(), backs.end());
  if (most == backs.end() || *most <= limit) return;
  const auto rows = std::count_if(backs.begin(), backs.end(), [&](double share) { return share > limit; });
  console.warning("backs of faces take more than 1 % of " + (rows == 1 ? "a row" : std::to_string(rows) + " rows") +
                  ", most of the row of " + names[static_cast<std::size_t>(most - backs.begin())] + ": " +
                  percentText(*most) +
                  "; a face may be turned over (--flip), or part of a surface lies inside a solid");
}

void printRows(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
               const radiosity::Discretization& discretization) {
  const std::vector<NamedSource> sources = sourcesOf(options, scene, discretization);
  const Families families = radiosity::familiesOf(scene);
  const RowReceivers receivers = options.bySurface ? reference::familiesAsReceivers(discretization, families)
                                                   : reference::elementsAsReceivers(discretization);
  const RowMethod method = methodOf(options, scene, discretization, receivers, context);
  std::vector<SparseRow> rows;
  std::vector<std::string> names;
  std::vector<double> surroundings, backs;
  tellCaptured(method, context.console);
  for (const NamedSource& from : sources) {
    rows.push_back(method.row(from.source));
    names.push_back(from.name);
    const OutsideShares outside = rows.back().takeOutside(receivers.area.size());
    if (outside.backs) {
      surroundings.push_back(*outside.surroundings);
      backs.push_back(*outside.backs);
    }
    context.console.message(
        "from " + from.name + ": " +
        (outside.backs ? "the share of the light that leaves the scene is " + roundedText(*outside.surroundings) +
                             "; the share that meets backs of faces is " + roundedText(*outside.backs)
                       : blockersIgnored));
  }
  warnOfBacks(backs, names, context.console);
  const Table table = tableOf(rows, scene, discretization, families, receivers);
  if (!context.json) return writeCsv(std::cout, table);
  const auto oneOrAll = [](const auto& values) {
    return values.size() == 1 ? nlohmann::ordered_json(values.front()) : nlohmann::ordered_json(values);
  };
  nlohmann::ordered_json result{{"from", oneOrAll(names)}};
  result.update(settingsOf(options));
  result.update({{"row", toJson(table)}});
  if (!backs.empty()) result.update({{"background", oneOrAll(surroundings)}, {"back", oneOrAll(backs)}});
  if (method.captured) result["captured"] = *method.captured;
  std::cout << toText(result);
}

reference::FormFactorMatrix factorsOf(const std::vector<SparseRow>& matrix) {
  reference::FormFactorMatrix factors{matrix.size(), {}};
  for (const SparseRow& row : matrix) {
    const std::vector<double> values = row.spread(row.value, matrix.size());
    factors.factors.insert(factors.factors.end(), values.begin(), values.end());
  }
  return factors;
}

/// Smooths the rows of a matrix.
reference::SmoothingMoves smooth(std::vector<SparseRow>& matrix, const RowReceivers& receivers) {
  reference::MatrixSmoother smoother(receivers.area);
  for (const SparseRow& row : matrix) smoother.add(row);
  const reference::SmoothingMoves moves = smoother.smooth();
  std::size_t next = 0;
  smoother.forEachRow([&](SparseRow row) { matrix[next++] = std::move(row); });
  return moves;
}

void tellChecks(const std::vector<OutsideShares>& outside, const reference::MatrixChecks& checks,
                const Families& families, Console& console) {
  const auto most = [&](std::optional<double> OutsideShares::*share) {
    const auto row =
        std::max_element(outside.begin(), outside.end(),
                         [&](const OutsideShares& a, const OutsideShares& b) { return a.*share < b.*share; });
    return roundedText(*((*row).*share)) + " (from " + families.names[static_cast<std::size_t>(row - outside.begin())] +
           ")";
  };
  console.message("rows sum to " + roundedText(checks.smallestRowSum) + " ... " + roundedText(checks.largestRowSum));
  console.message(outside.front().backs
                      ? "the share of the light that leaves the scene is at most " +
                            most(&OutsideShares::surroundings) + "; the share that meets backs of faces is at most " +
                            most(&OutsideShares::backs)
                      : blockersIgnored);
  console.message("reciprocity is missed by at most " + percentText(checks.reciprocity) +
                  " of the flux of the smaller surface (" + families.names[checks.from] + " and " +
                  families.names[checks.to] + ")");
}

/// Identifies the computation of a matrix.
Computation computationOf(const FormFactorOptions& options, const radiosity::Scene& scene) {
  nlohmann::ordered_json settings = settingsOf(options);
  settings.update(toJson(options.discretization));
  settings.update(toJson(options.id));
  return {programVersion(), reference::sha256(hashOf(scene) + toText(settings))};
}

/// The file that rows are kept in; null without --output, and on all ranks but the one that writes.
std::unique_ptr<RowFile> rowFileOf(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
                                   const std::set<std::string>& companions = {}) {
  if (options.output.empty() || !context.isWriter()) return nullptr;
  const std::string writer = "formfactors " + options.output.filename().string();
  return std::make_unique<RowFile>(Output{Output::Kind::File, options.output, writer, context.inputs(scene.files)},
                                   computationOf(options, scene), companions);
}

/// Gives the rows that an earlier run left to `take`.
void goOn(RowFile& file, std::size_t receivers, Console& console, const std::function<void(SparseRow row)>& take) {
  const bool wasDamaged = file.replay(receivers, take);
  if (wasDamaged)
    console.warning("row " + std::to_string(file.rows()) +
                    " of the unfinished result is damaged: it and those behind it are computed again");
  if (file.rows() > 0)
    console.message("goes on after " + std::to_string(file.rows()) + " rows that an earlier run left");
}

/// Gives all rows to `take`, in order, on the rank that writes; the ranks of a parallel run share the work. Only rows
/// of other ranks come as text.
void forEachRow(const RowMethod& method, const Families& families, RowFile* file, Context& context,
                const std::function<void(SparseRow row)>& take) {
  const std::size_t count = families.names.size();
  if (file) goOn(*file, count, context.console, take);
  std::map<std::size_t, SparseRow> own;
  const auto compute = [&](std::size_t from) {
    SparseRow row = families.surfaces[from].empty() ? SparseRow() : method.row({families.surfaces[from]});
    if (!context.isWriter()) return lineOf(row);
    own[from] = std::move(row);
    return std::string();
  };
  const auto keep = [&](std::size_t from, const std::string& line) {
    SparseRow row = line.empty() ? std::move(own[from]) : *rowOf(line);
    own.erase(from);
    if (file) file->append(row);
    take(std::move(row));
    context.console.progress(static_cast<double>(from + 1) / static_cast<double>(count), families.names[from]);
  };
  radiosity::run(context.ranks.get(),
                 {.first = file ? file->rows() : 0, .end = count, .compute = compute, .take = keep});
  context.console.endProgress();
}

/// What the matrix says of itself: names only where they are more than numbers.
reference::MatrixHeading headingOf(const Families& families, const RowReceivers& receivers) {
  reference::MatrixHeading heading{receivers.area};
  for (std::size_t f = 0; f < families.names.size(); ++f)
    if (families.names[f] != std::to_string(f)) {
      heading.names = families.names;
      break;
    }
  return heading;
}

/// The sum of the errors of the facets of a row.
double errorOf(const SparseRow& row, std::size_t facets) {
  double sum = 0;
  for (std::size_t k = 0; k < row.error.size(); ++k)
    if (row.column[k] < facets) sum += row.error[k];
  return sum;
}

/// Writes the rows of a matrix, or smooths them first, and collects what the JSON file says of them.
class MatrixOutput {
 public:
  /// `watch` is called with each row that is written and the estimate of its error, 0 if there is none.
  using Watch = std::function<void(const SparseRow& row, double error)>;

  MatrixOutput(const std::filesystem::path& file, const reference::MatrixHeading& heading, bool isSmooth, Watch watch)
      : heading_(heading), writer_(reference::matrixSink(file, heading)), watch_(std::move(watch)) {
    if (isSmooth) smoother_.emplace(heading.area);
  }

  void take(SparseRow row) {
    for (double& error : row.error) error = reference::asStored(error);
    measured_.push_back({row.rowError.value_or(0), errorOf(row, heading_.facets())});
    hasRowErrors_ = hasRowErrors_ || row.rowError;
    if (smoother_)
      smoother_->add(row);
    else
      write(row);
  }
  /// To be called after the last row. Returns how far form factors moved, if they were smoothed.
  std::optional<reference::SmoothingMoves> finish() {
    std::optional<reference::SmoothingMoves> moves;
    if (smoother_) {
      moves = smoother_->smooth();
      smoother_->forEachRow([this](const SparseRow& row) { write(row); });
    }
    writer_->finish();
    return moves;
  }
  nlohmann::ordered_json toJson() const {
    nlohmann::ordered_json text{{"entries", entries_}, {"row_sums", {smallestSum_, largestSum_}}};
    if (hasRowErrors_) text["errors"] = errors_;
    return text;
  }

 private:
  void write(const SparseRow& row) {
    double sum = 0;
    for (const double factor : row.value) sum += factor;
    entries_ += row.value.size() - static_cast<std::size_t>(std::count(row.value.begin(), row.value.end(), 0.0));
    if (sum > 0) {  // a face without area has an empty row
      smallestSum_ = std::min(smallestSum_, sum);
      largestSum_ = std::max(largestSum_, sum);
    }
    const auto& [error, ofEntries] = measured_[errors_.size()];
    const bool isChanged = smoother_ && ofEntries > 0;
    errors_.push_back(isChanged ? error * errorOf(row, heading_.facets()) / ofEntries : error);
    if (watch_) watch_(row, errors_.back());
    writer_->write(row);
  }

  reference::MatrixHeading heading_;
  std::unique_ptr<reference::RowSink> writer_;
  Watch watch_;
  std::optional<reference::MatrixSmoother> smoother_;
  /// The error of a row before it is smoothed, and the sum of those of its entries.
  struct RowError {
    double row = 0, ofEntries = 0;
  };
  std::vector<RowError> measured_;  ///< one per row; 0 if the method or the row has none
  std::vector<double> errors_;      ///< of the rows that are written
  bool hasRowErrors_ = false;
  std::size_t entries_ = 0;
  double smallestSum_ = std::numeric_limits<double>::infinity(), largestSum_ = 0;
};

/// The JSON file's words on smoothing.
nlohmann::ordered_json tellMoves(const reference::SmoothingMoves& moves, bool hasErrors, Console& console) {
  nlohmann::ordered_json text{{"largest", moves.largest}, {"root_mean_square", moves.rootMeanSquare}};
  std::string beyond;
  if (hasErrors) {
    text["beyond_their_error"] = moves.beyondErrors;
    beyond = "; " + std::to_string(moves.beyondErrors) + " moved by more than their estimated error";
  }
  console.message("smoothing moved form factors by at most " + roundedText(moves.largest) + ", root mean square " +
                  roundedText(moves.rootMeanSquare) + beyond);
  return text;
}

/// The name of the JSON file beside a matrix: that of the matrix with another ending, or, where a file of this name
/// describes another matrix, with `.json` behind it.
std::string descriptionOf(const std::filesystem::path& matrix) {
  const std::string name = std::filesystem::path(matrix).replace_extension(".json").filename();
  const std::string text = raster::tryReadFile(matrix.parent_path() / name).value_or("");
  const auto other = nlohmann::json::parse(text, nullptr, false);
  const bool isOfOther = other.is_object() && other.value("matrix", nlohmann::json()).is_string() &&
                         other["matrix"] != matrix.filename().string();
  return isOfOther ? matrix.filename().string() + ".json" : name;
}

/// Writes the sparse matrix, and the JSON file beside it.
void writeMatrix(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
                 const radiosity::Discretization& discretization) {
  const Families families = options.scene.settings.facets ? radiosity::facetsOf(scene) : radiosity::familiesOf(scene);
  const RowReceivers receivers = reference::familiesAsReceivers(discretization, families);
  const std::string description = descriptionOf(options.output);
  // These refuse a wrong facet or file before there is a file of rows.
  FacetValues values(families.names.size(), options.vtuRows);
  std::optional<FacetFile> facets;
  if (!options.vtu.empty() && context.isWriter())
    facets.emplace(options.vtu, "formfactors --vtu", context.inputs(scene.files));
  const std::unique_ptr<RowFile> file = rowFileOf(options, context, scene, {description});
  const RowMethod method = methodOf(options, scene, discretization, receivers, context);
  if (!file) return forEachRow(method, families, nullptr, context, {});
  reference::MatrixHeading heading = headingOf(families, receivers);
  heading.hasErrors = options.maxError || options.method == "rays";
  std::vector<double> backs;
  MatrixOutput matrix(file->staging().file(), heading, options.smooth, [&](const SparseRow& row, double error) {
    const auto place = row.placeOf(families.names.size() + 1);
    backs.push_back(place ? row.value[*place] : 0);
    if (facets) values.take(row, error);
  });
  forEachRow(method, families, file.get(), context, [&](SparseRow row) { matrix.take(std::move(row)); });
  const std::optional<reference::SmoothingMoves> moves = matrix.finish();
  if (facets) facets->write(options.scene.file, options.scene.settings.sides, values.arrays());
  nlohmann::ordered_json result{{"matrix", options.output.filename().string()},
                                {"sha256", file->staging().hashes().at(options.output.filename())}};
  result.update(nlohmann::ordered_json::parse(reference::aboutMatrix(heading)));
  result.update(matrix.toJson());
  if (moves) result["smoothing"] = tellMoves(*moves, heading.hasErrors, context.console);
  warnOfBacks(backs, families.names, context.console);
  result["settings"] = settingsOf(options);
  result["settings"].update(toJson(options.discretization));
  result["area"] = heading.area;
  raster::writeFile(file->staging().folder() / description, toText(result));
  file->finish(description);
  if (context.json) std::cout << toText(result);
}

void printMatrix(const FormFactorOptions& options, Context& context, const radiosity::Scene& scene,
                 const radiosity::Discretization& discretization) {
  const Families families = radiosity::familiesOf(scene);
  const RowReceivers receivers = reference::familiesAsReceivers(discretization, families);
  const std::unique_ptr<RowFile> file = rowFileOf(options, context, scene);
  const RowMethod method = methodOf(options, scene, discretization, receivers, context);
  std::vector<SparseRow> matrix;
  std::vector<OutsideShares> outside;
  forEachRow(method, families, file.get(), context, [&](SparseRow row) {
    outside.push_back(row.takeOutside(families.names.size()));
    matrix.push_back(std::move(row));
  });
  if (!context.isWriter()) return;
  nlohmann::ordered_json result = settingsOf(options);
  if (options.smooth) {
    const bool hasErrors = !matrix.front().error.empty();
    result["smoothing"] = tellMoves(smooth(matrix, receivers), hasErrors, context.console);
  }
  const reference::MatrixChecks checks = reference::checkMatrix(factorsOf(matrix), receivers.area);
  tellCaptured(method, context.console);
  tellChecks(outside, checks, families, context.console);
  std::vector<double> backs;
  for (const OutsideShares& shares : outside) backs.push_back(shares.backs.value_or(0));
  warnOfBacks(backs, families.names, context.console);
  const auto names = [&](std::size_t index) -> std::vector<Cell> {
    return {families.names[index / matrix.size()], families.names[index % matrix.size()]};
  };
  const Table table = tableOf(matrix, matrix.size(), {"from", "to"}, names);
  std::ostringstream text;
  std::ostream& output = file ? text : std::cout;
  if (context.json) {
    nlohmann::ordered_json found = {{"row_sums", {checks.smallestRowSum, checks.largestRowSum}},
                                    {"reciprocity", checks.reciprocity}};
    if (method.captured) found["captured"] = *method.captured;
    if (file) std::cout << toText(found);
    result["matrix"] = toJson(table);
    result.update(found);
    output << toText(result);
  } else {
    writeCsv(output, table);
  }
  if (!file) return;
  raster::writeFile(file->staging().file(), text.str());
  file->finish();
}

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

/// Meshes without materials have facets, of one texel unless another size is given.
void completeFacets(FormFactorOptions& options, Command command) {
  if (options.facets || (radiosity::isPlainMesh(options.scene.file) && !options.bySurface))
    chooseFacets(command, options.scene.settings, options.discretization);
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
                [options](const std::vector<std::string>& texts) { options->at = texts; })
      .excludes(from)
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
                [options](const std::vector<std::string>& texts) {
                  for (const std::string& text : texts)
                    options->vtuRows.push_back(integerOption("--row", text, 0, std::numeric_limits<int>::max()));
                })
      .needs(vtu);
  const Command method = command.under("Form factors");
  const Option maxError = addPositive(
      method, "--max-error", options->maxError, 1,
      "with --all --facets -o, bound the error of every row, which is the sum of the absolute errors of its form "
      "factors: hemicubes tell what is hidden, closed forms tell the rest (default: by the other options)");
  addMethod(
      method, options->method, {"rays", "analytic"},
      "compute form factors with this projection, with rays or with closed forms (analytic), which ignore blockers "
      "(default hemicube)");
  addDrawingOptions(command, options->drawing);
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
  for (const char* chosen : {"--resolution", "--orientation", "--split", "--pixels-per-element", "--discretize",
                             "--method", "--samples", "--texels", "--texel-size", "--surface"})
    maxError.excludes(command.option(chosen));
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
    if (options->all && !options->bySurface) requireMatrixFile(*options);
    completeFacets(*options, command);
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
