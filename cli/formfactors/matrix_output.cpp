#include "cli/formfactors/matrix_output.h"

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <limits>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "cli/common/json.h"
#include "cli/formfactors/row_file.h"
#include "cli/scene/facet_file.h"
#include "cli/scene/scene_hash.h"
#include "radiosity/meshes/polygon_mesh.h"
#include "radiosity/ranks/shared_tasks.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"
#include "reference/matrices/matrix_files.h"
#include "reference/matrices/matrix_rows.h"
#include "reference/matrices/measured_twice.h"
#include "reference/matrices/npz_file.h"
#include "reference/matrices/smoothing.h"
#include "reference/matrices/sparse_row.h"
#include "reference/truth/solution/form_factor_matrix.h"

namespace hemitex::cli {
namespace {

using radiosity::Families;
using reference::OutsideShares;
using reference::RowMethod;
using reference::RowReceivers;
using reference::SparseRow;

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
  reference::MatrixSmoother smoother(receivers.area, reference::maxStandardErrors);
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

/// What a matrix of form factors says of each facet, as values that a picture of the mesh shows.
class FacetValues {
 public:
  /// `chosen` are facets whose rows are shown. Throws InputError if one is not below `facets`.
  FacetValues(std::size_t facets, const std::vector<int>& chosen)
      : facets_(facets), chosen_(chosen), rows_(chosen.size()) {
    for (const int facet : chosen_)
      if (static_cast<std::size_t>(facet) >= facets)
        throw raster::InputError("the mesh has no facet " + std::to_string(facet),
                                 "it has " + std::to_string(facets) + ", counted from 0");
  }

  /// Takes the next row, with the columns of surroundings and backs, and the estimate of its error.
  void take(const reference::SparseRow& row, double error) {
    for (std::size_t c = 0; c < chosen_.size(); ++c)
      if (static_cast<std::size_t>(chosen_[c]) == sum_.values.size()) rows_[c] = row;
    double sum = 0, surroundings = 0, backs = 0;
    for (std::size_t k = 0; k < row.column.size(); ++k)
      (row.column[k] < facets_ ? sum : row.column[k] == facets_ ? surroundings : backs) += row.value[k];
    sum_.values.push_back(sum);
    surroundings_.values.push_back(surroundings);
    backs_.values.push_back(backs);
    error_.values.push_back(error);
  }

  /// After all rows, one value per facet: `row_sum` over facets, `surroundings`, `backs`, and where rows have one the
  /// estimated `error`. Then for each chosen facet N `form_factor_from_N`, and `standard_error_from_N` if there are
  /// any.
  std::vector<radiosity::FaceArray> arrays() const {
    std::vector<radiosity::FaceArray> arrays{sum_, surroundings_, backs_};
    if (std::any_of(error_.values.begin(), error_.values.end(), [](double e) { return e > 0; }))
      arrays.push_back(error_);
    for (std::size_t c = 0; c < chosen_.size(); ++c) {
      const std::string facet = std::to_string(chosen_[c]);
      const reference::SparseRow& row = rows_[c];
      arrays.push_back({"form_factor_from_" + facet, 1, row.spread(row.value, facets_)});
      if (!row.error.empty()) arrays.push_back({"standard_error_from_" + facet, 1, row.spread(row.error, facets_)});
    }
    return arrays;
  }

 private:
  std::size_t facets_;
  radiosity::FaceArray sum_{"row_sum"}, surroundings_{"surroundings"}, backs_{"backs"}, error_{"error"};
  std::vector<int> chosen_;
  std::vector<reference::SparseRow> rows_;  ///< of the chosen facets
};

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

/// Writes the rows of a matrix, or smooths them first, and collects what the JSON file says of them.
class MatrixOutput {
 public:
  /// `isBounded` tells that errors are bounds, and not standard errors.
  /// `watch` is called with each row that is written and the estimate of its error, 0 if there is none.
  using Watch = std::function<void(const SparseRow& row, double error)>;

  MatrixOutput(const std::filesystem::path& file, const reference::MatrixHeading& heading, bool isSmooth,
               bool isBounded, Watch watch)
      : writer_(reference::matrixSink(file, heading)),
        watch_(std::move(watch)),
        rows_(heading.area, isSmooth, isBounded, [this](const SparseRow& row, double error) { write(row, error); }) {}

  void take(SparseRow row) { rows_.add(std::move(row)); }
  /// To be called after the last row. Returns how far form factors moved, if they were smoothed.
  std::optional<reference::SmoothingMoves> finish() {
    const std::optional<reference::SmoothingMoves> moves = rows_.finish();
    writer_->finish();
    return moves;
  }
  /// The estimated errors of rows.
  const std::vector<double>& errors() const { return errors_; }
  nlohmann::ordered_json toJson() const {
    nlohmann::ordered_json text{{"entries", entries_}, {"row_sums", {smallestSum_, largestSum_}}};
    if (rows_.hasRowErrors()) text["errors"] = errors_;
    return text;
  }

 private:
  void write(const SparseRow& row, double error) {
    double sum = 0;
    for (const double factor : row.value) sum += factor;
    entries_ += row.value.size() - static_cast<std::size_t>(std::count(row.value.begin(), row.value.end(), 0.0));
    if (sum > 0) {  // a face without area has an empty row
      smallestSum_ = std::min(smallestSum_, sum);
      largestSum_ = std::max(largestSum_, sum);
    }
    errors_.push_back(error);
    if (watch_) watch_(row, error);
    writer_->write(row);
  }

  std::unique_ptr<reference::RowSink> writer_;
  Watch watch_;
  reference::MatrixRows rows_;
  std::vector<double> errors_;  ///< of the rows that are written
  std::size_t entries_ = 0;
  double smallestSum_ = std::numeric_limits<double>::infinity(), largestSum_ = 0;
};

/// Says which rows have a larger estimated error than was asked for, in a list for the JSON file. That is a failure if
/// the user insists on it.
std::vector<std::size_t> rowsAbove(const std::vector<double>& errors, const FormFactorOptions& options,
                                   const std::vector<std::string>& names, Context& context) {
  std::vector<std::size_t> rows;
  for (std::size_t r = 0; r < errors.size(); ++r)
    if (errors[r] > *options.maxError) rows.push_back(r);
  if (rows.empty()) return rows;
  const auto worst = static_cast<std::size_t>(std::max_element(errors.begin(), errors.end()) - errors.begin());
  context.console.warning(std::to_string(rows.size()) + " of " + std::to_string(errors.size()) +
                          " rows have an estimated error above --max-error " + roundedText(*options.maxError) +
                          ": at most " + roundedText(errors[worst]) + ", in row " + names[worst]);
  context.failed = context.failed || context.insists;
  return rows;
}

/// The JSON file's words on smoothing.
nlohmann::ordered_json tellMoves(const reference::SmoothingMoves& moves, bool hasErrors, Console& console) {
  nlohmann::ordered_json text{{"largest", moves.largest}, {"root_mean_square", moves.rootMeanSquare}};
  if (hasErrors) text["rows_missed"] = moves.missed;
  console.message("smoothing moved form factors by at most " + roundedText(moves.largest) + ", root mean square " +
                  roundedText(moves.rootMeanSquare));
  if (hasErrors && !moves.missed.empty())
    console.warning(
        std::to_string(moves.missed.size()) +
        " rows would keep their sums only if form factors moved by more than their errors; their sums change");
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

}  // namespace

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
  reference::MatrixHeading heading = reference::headingOf(receivers.area, families.names);
  heading.hasErrors = options.maxError || options.method == "rays";
  std::vector<double> backs;
  MatrixOutput matrix(file->staging().file(), heading, options.smooth, options.maxError.has_value(),
                      [&](const SparseRow& row, double error) {
                        const auto place = row.placeOf(families.names.size() + 1);
                        backs.push_back(place ? row.value[*place] : 0);
                        if (facets) values.take(row, error);
                      });
  if (options.maxError) {
    reference::MeasuredTwice measured(heading.area);
    forEachRow(method, families, file.get(), context, [&](const SparseRow& row) { measured.add(row); });
    std::uint32_t next = 0;
    file->reread(families.names.size(), [&](SparseRow row) {
      measured.widen(next++, row);
      matrix.take(std::move(row));
    });
  } else {
    forEachRow(method, families, file.get(), context, [&](SparseRow row) { matrix.take(std::move(row)); });
  }
  const std::optional<reference::SmoothingMoves> moves = matrix.finish();
  if (facets) facets->write(options.scene.file, options.scene.settings.sides, values.arrays());
  nlohmann::ordered_json result{{"matrix", options.output.filename().string()},
                                {"sha256", file->staging().hashes().at(options.output.filename())}};
  result.update(nlohmann::ordered_json::parse(reference::aboutMatrix(heading)));
  result.update(matrix.toJson());
  if (options.maxError) result["rows_above"] = rowsAbove(matrix.errors(), options, families.names, context);
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

}  // namespace hemitex::cli
