#include "python/bindings/form_factors.h"

#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <initializer_list>
#include <limits>
#include <memory>
#include <utility>

#include "python/bindings/arrays.h"
#include "python/bindings/renderers.h"
#include "python/bindings/scenes.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/patch_points.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/projection_kinds.h"
#include "reference/matrices/matrix_difference.h"
#include "reference/matrices/matrix_files.h"
#include "reference/matrices/matrix_judge.h"
#include "reference/matrices/matrix_rows.h"
#include "reference/matrices/measured_twice.h"
#include "reference/rows/scene_rows.h"
#include "reference/truth/closed_forms/polygon_to_polygon.h"

namespace hemitex::python {
namespace {

using raster::InputError;
using reference::OutsideShares;
using reference::RowReceivers;
using reference::SparseRow;
using namespace py::literals;

/// A name, the number of a facet or surface, or a tuple (name, column, row).
reference::Source sourceOf(const Elements& elements, const py::object& source) {
  if (PyIndex_Check(source.ptr()) != 0) {
    const std::vector<std::vector<std::uint32_t>> facets =
        elements.facets ? familiesOf(elements).surfaces : std::vector<std::vector<std::uint32_t>>();
    const std::size_t count = elements.facets ? facets.size() : elements.scene->surfaces.size();
    const auto number =
        static_cast<std::uint32_t>(integerOf(source, "source", 0, static_cast<std::int64_t>(count) - 1));
    if (!elements.facets) return {{number}};
    if (facets[number].empty()) throw InputError("facet " + std::to_string(number) + " has no area that is open");
    return {facets[number]};
  }
  if (py::isinstance<py::str>(source)) return {radiosity::surfacesNamed(*elements.scene, textOf(source, "source"))};
  if (!py::isinstance<py::tuple>(source) || py::len(source) != 3)
    throw InputError("`source` is neither a name, the number of a surface nor (name, column, row)");
  const auto place = py::reinterpret_borrow<py::tuple>(source);
  return reference::texelSource(*elements.scene, elements.discretization, textOf(place[0], "source"),
                                static_cast<int>(integerOf(place[1], "column", -1, 1 << 20)),
                                static_cast<int>(integerOf(place[2], "row", -1, 1 << 20)));
}

/// Throws InputError if one of the settings is given, which what was `chosen` does not use.
void refuse(const Settings& settings, std::initializer_list<const char*> names, const std::string& chosen) {
  for (const char* name : names)
    if (settings.value(name))
      throw InputError("`" + std::string(name) + "` has no effect with " + chosen, "omit one of them");
}

reference::RowMethod methodOf(const Elements& elements, const RowReceivers& receivers, const Settings& settings,
                              const py::object& makeRenderer) {
  const std::string method = settings.text("method").value_or("hemicube");
  const std::string chosen = settings.value("max_error") ? "`max_error`" : "`method` " + raster::excerpt(method);
  if (method != "rays") refuse(settings, {"samples", "seed", "aimed"}, chosen);
  if (method == "rays" || method == "analytic" || settings.value("max_error"))
    refuse(settings, {"resolution", "orientation", "split", "elements_by"}, chosen);
  if (const auto maxError = settings.number("max_error", 1e-9, 1)) {
    if (!elements.facets) throw InputError("`max_error` is for facets", "load the scene with facets=True");
    if (method != "hemicube") throw InputError("`max_error` chooses how rows are measured", "omit `method`");
    return unlocked([&] { return reference::facetMethod(*elements.scene, receivers, *maxError, 64); });
  }
  if (method == "rays") {
    reference::RayOptions rays;
    assign(rays.samples, settings.integer("samples", 64, 1 << 28));
    rays.seed = static_cast<std::uint32_t>(settings.integer("seed", 0, std::numeric_limits<int>::max()).value_or(0));
    assign(rays.aimed, settings.flag("aimed"));
    return unlocked([&] { return reference::rayMethod(*elements.scene, elements.discretization, receivers, rays); });
  }
  if (method == "analytic")
    return unlocked([&] { return reference::analyticMethod(*elements.scene, elements.discretization, receivers); });
  const radiosity::DrawingSettings drawing = drawingSettings(settings, {"rays", "analytic"});
  const radiosity::IdSettings ids = idSettings(settings);
  const radiosity::RendererFactory renderer = rendererFactory(makeRenderer);
  return unlocked([&] {
    return reference::drawnMethod(*elements.scene, elements.discretization, receivers,
                                  radiosity::layOut(elements.discretization, ids), drawing, renderer);
  });
}

py::dict formFactorRow(const SharedElements& elements, const py::object& source, const py::dict& given,
                       const py::object& makeRenderer) {
  const Settings settings(given);
  const bool bySurface = settings.flag("by_surface").value_or(false);
  const radiosity::Families families = familiesOf(*elements);
  const RowReceivers receivers = bySurface ? reference::familiesAsReceivers(elements->discretization, families)
                                           : reference::elementsAsReceivers(elements->discretization);
  const reference::Source from = sourceOf(*elements, source);
  const reference::RowMethod method = methodOf(*elements, receivers, settings, makeRenderer);
  SparseRow row = unlocked([&] { return method.row(from); });
  const std::size_t count = receivers.area.size();
  const OutsideShares outside = row.takeOutside(count);
  return py::dict("form_factor"_a = toArray(row.spread(row.value, count)), "area"_a = toArray(receivers.area),
                  "names"_a = bySurface ? py::cast(families.names) : py::object(py::none()),
                  "standard_error"_a =
                      row.error.empty() ? py::object(py::none()) : py::object(toArray(row.spread(row.error, count))),
                  "surroundings"_a = outside.surroundings, "backs"_a = outside.backs, "captured"_a = method.captured);
}

/// Compressed rows as NumPy arrays of SciPy's types, and the errors of their entries or None.
py::dict rowsDict(reference::SparseMatrix matrix) {
  std::vector<std::int64_t> starts(matrix.rowStart.begin(), matrix.rowStart.end());
  std::vector<std::int64_t> columns(matrix.column.begin(), matrix.column.end());
  const std::size_t rows = matrix.rows();
  const py::object errors = matrix.error.empty() ? py::object(py::none()) : toArray(std::move(matrix.error));
  return py::dict("data"_a = toArray(std::move(matrix.value)), "indices"_a = toArray(std::move(columns)),
                  "errors"_a = errors, "indptr"_a = toArray(std::move(starts)),
                  "shape"_a = py::make_tuple(rows, matrix.columns));
}

py::dict formFactorMatrix(const SharedElements& elements, const py::dict& given, const py::object& makeRenderer,
                          py::object progress) {
  const Settings settings(given);
  const radiosity::Families families = familiesOf(*elements);
  const RowReceivers receivers = reference::familiesAsReceivers(elements->discretization, families);
  const reference::RowMethod method = methodOf(*elements, receivers, settings, makeRenderer);
  const std::size_t count = families.names.size();
  const bool isBounded = settings.value("max_error").has_value();
  const bool isSmooth = settings.flag("smooth").value_or(false);
  reference::SparseMatrix matrix{.columns = count + 2};
  std::vector<double> errors;
  Progress told(std::move(progress));
  unlocked([&] {
    reference::MatrixRows rows(receivers.area, isSmooth, isBounded, [&](const SparseRow& row, double error) {
      matrix.append(row);
      errors.push_back(isBounded ? error : reference::errorOfEntries(row, count));
    });
    reference::MeasuredTwice measured(receivers.area);
    std::vector<SparseRow> waiting;
    for (std::size_t from = 0; from < count; ++from) {
      told.tell(static_cast<double>(from) / static_cast<double>(count));
      SparseRow row = families.surfaces[from].empty() ? SparseRow() : method.row({families.surfaces[from]});
      if (!isBounded) {
        rows.add(std::move(row));
        continue;
      }
      measured.add(row);
      waiting.push_back(std::move(row));
    }
    for (std::size_t from = 0; from < waiting.size(); ++from) {
      measured.widen(static_cast<std::uint32_t>(from), waiting[from]);
      rows.add(std::move(waiting[from]));
    }
    rows.finish();
    told.tell(1);
  });
  const bool hasErrors = isBounded || !matrix.error.empty();
  py::dict result = rowsDict(std::move(matrix));
  result["area"] = toArray(receivers.area);
  result["error"] = hasErrors ? py::object(toArray(std::move(errors))) : py::object(py::none());
  result["names"] = families.names;
  return result;
}

double polygonFormFactor(const py::object& from, const py::object& to) {
  const auto polygon = [](const py::object& corners, const char* name) {
    const Array<double> array = numbers(corners, name, {-1, 3});
    if (array.length() < 3) throw InputError("`" + std::string(name) + "` has fewer than 3 corners");
    if (array.length() > 1000) throw InputError("`" + std::string(name) + "` has more than 1000 corners");
    for (const double coordinate : array.values)
      if (std::abs(coordinate) > 1e18)
        throw InputError("`" + std::string(name) + "` has a coordinate above 1e18 in size", "scale it down");
    return vectorsOf(array);
  };
  const std::vector<glm::dvec3> a = polygon(from, "source"), b = polygon(to, "receiver");
  for (const std::vector<glm::dvec3>* corners : {&a, &b}) {
    glm::dvec3 normal(0.0);
    for (std::size_t k = 1; k + 1 < corners->size(); ++k)
      normal += glm::cross((*corners)[k] - (*corners)[0], (*corners)[k + 1] - (*corners)[0]);
    if (!(glm::length(normal) > 0)) throw InputError("a polygon has no area");
  }
  return unlocked([&] { return reference::polygonToPolygon(a, b); });
}

/// A matrix of SciPy's compressed rows (data, indices, indptr) with this many rows. `errors` are those of its entries,
/// or None.
reference::SparseMatrix matrixOf(const py::object& data, const py::object& indices, const py::object& indptr,
                                 const py::object& errors, std::int64_t rows, std::int64_t columns) {
  const Array<double> values = numbers(data, "matrix", {-1});
  const Array<std::int64_t> starts = integers(indptr, "matrix", {rows + 1}, 0, values.shape[0]);
  const Array<std::int64_t> column = integers(indices, "matrix", {values.shape[0]}, 0, columns - 1);
  reference::SparseMatrix matrix{.columns = static_cast<std::uint64_t>(columns)};
  matrix.rowStart.assign(starts.values.begin(), starts.values.end());
  matrix.column.assign(column.values.begin(), column.values.end());
  matrix.value.assign(values.values.begin(), values.values.end());
  if (!errors.is_none()) {
    const Array<double> ofEntries = numbers(errors, "errors", {values.shape[0]});
    matrix.error.assign(ofEntries.values.begin(), ofEntries.values.end());
  }
  unlocked([&] { reference::checkAndSort(matrix, "the matrix"); });
  return matrix;
}

py::dict checkMatrix(const SharedElements& facets, const py::object& data, const py::object& indices,
                     const py::object& indptr, const py::object& columns, const py::dict& given) {
  const Settings settings(given);
  reference::JudgeSettings judge;
  assign(judge.tolerance, settings.number("tolerance", 0, 10));
  assign(judge.rows, settings.integer("rows", 1, 1 << 20));
  assign(judge.samples, settings.integer("samples", 64, 1 << 26));
  const radiosity::Families families = familiesOf(*facets);
  const auto count = static_cast<std::int64_t>(families.names.size());
  const std::int64_t width = integerOf(columns, "columns", count, count + 2);
  const reference::SparseMatrix matrix = matrixOf(data, indices, indptr, py::none(), count, width);
  const reference::MatrixVerdict verdict = unlocked([&] {
    return reference::judgeMatrix(
        matrix, {*facets->scene, facets->discretization, families.ofSurface, families.names.size()}, judge);
  });
  return py::dict("problems"_a = verdict.problems, "fault"_a = verdict.fault,
                  "largest_row_sum"_a = verdict.largestRowSum, "reciprocity"_a = verdict.reciprocity,
                  "difference"_a = verdict.difference, "noise"_a = verdict.noise,
                  "measured_rows"_a = verdict.measuredRows);
}

py::dict readMatrix(const std::filesystem::path& file) {
  reference::MatrixFile found = unlocked([&] { return reference::readMatrix(file); });
  py::dict result = rowsDict(std::move(found.matrix));
  result["area"] = found.area.empty() ? py::object(py::none()) : py::object(toArray(std::move(found.area)));
  return result;
}

/// Writes a matrix with the columns of surroundings and backs, as `hemitex formfactors` does.
void writeMatrix(const std::filesystem::path& file, const py::object& data, const py::object& indices,
                 const py::object& indptr, const py::object& errors, const py::object& area,
                 const std::vector<std::string>& names) {
  const Array<double> areas = numbers(area, "area", {static_cast<py::ssize_t>(names.size())});
  reference::MatrixHeading heading = reference::headingOf({areas.values.begin(), areas.values.end()}, names);
  heading.hasErrors = !errors.is_none();
  const auto rows = static_cast<std::int64_t>(names.size());
  const reference::SparseMatrix matrix = matrixOf(data, indices, indptr, errors, rows, rows + 2);
  unlocked([&] {
    const auto sink = reference::matrixSink(file, heading);
    for (std::size_t r = 0; r < matrix.rows(); ++r) sink->write(matrix.row(r));
    sink->finish();
  });
}

/// `first` and `second` are (data, indices, indptr, columns), with a row for each area.
py::dict compareMatrices(const py::tuple& first, const py::tuple& second, const py::object& area) {
  const Array<double> areas = numbers(area, "area", {-1});
  const auto matrix = [&](const py::tuple& parts) {
    return matrixOf(parts[0], parts[1], parts[2], py::none(), areas.shape[0],
                    integerOf(py::object(parts[3]), "columns", areas.shape[0], areas.shape[0] + 2));
  };
  const reference::SparseMatrix a = matrix(first), b = matrix(second);
  reference::MatrixDifference found = unlocked([&] {
    return reference::matrixDifference(a, b, {areas.values.begin(), areas.values.end()});
  });
  return py::dict("row_sum"_a = toArray(std::move(found.sum)), "difference"_a = toArray(std::move(found.difference)),
                  "difference_received"_a = toArray(std::move(found.received)), "share"_a = found.share);
}

/// The element of each item ID; -1 for the background and -2 for backs.
std::vector<std::int64_t> elementsIn(const raster::ItemBuffer& buffer, const Elements& elements,
                                     const radiosity::IdLayout& layout) {
  std::vector<std::int64_t> numbers;
  for (const raster::ItemId id : buffer.ids) {
    const auto element = radiosity::elementOf(elements.discretization, layout, id);
    numbers.push_back(element ? std::int64_t{*element} : id == raster::backId(layout.format) ? -2 : -1);
  }
  return numbers;
}

/// The faces of a projection over the centre of an element, or of the first patch of a surface, with their item IDs.
py::list hemicube(const SharedElements& elements, const py::object& source, const py::dict& given,
                  const py::object& makeRenderer) {
  const Settings settings(given);
  const reference::Source from = sourceOf(*elements, source);
  const radiosity::DrawingSettings drawing = drawingSettings(settings);
  const radiosity::Scene& scene = *elements->scene;
  const radiosity::Discretization& discretization = elements->discretization;
  const radiosity::IdLayout layout = radiosity::layOut(discretization, idSettings(settings));
  const radiosity::RendererFactory makeIds = rendererFactory(makeRenderer);
  const std::uint32_t surface = from.surfaces.front();
  radiosity::Projection projection;
  std::vector<raster::Face> faces;
  std::vector<raster::ItemBuffer> buffers;
  unlocked([&] {
    const radiosity::Patch& patch = discretization.patches.list[discretization.grids[surface].firstPatch];
    const radiosity::SurfacePoint point = from.element ? radiosity::elementCentre(scene, discretization, *from.element)
                                                       : radiosity::patchCentre(scene, discretization, patch);
    const auto renderer = makeIds(radiosity::makeDrawList(scene, discretization, layout));
    radiosity::ProjectedFormFactors rows(scene, discretization, layout, *renderer,
                                         {.resolution = drawing.resolution, .projection = drawing.projection});
    const radiosity::View view = rows.viewFrom({.surface = surface, .point = point});
    projection = *view.projection;
    faces = view.faces;
    buffers = raster::render(*renderer, faces, view.skipped);
  });
  py::list result;
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Shape shape{buffers[f].height, buffers[f].width};
    py::dict face("face"_a = toDict(faces[f]), "weights"_a = toArray(radiosity::deltaFormFactors(projection, f), shape),
                  "elements"_a = toArray(elementsIn(buffers[f], *elements, layout), shape));
    face["ids"] = toArray(std::move(buffers[f]));
    result.append(face);
  }
  return result;
}

}  // namespace

radiosity::DrawingSettings drawingSettings(const Settings& settings, const std::vector<std::string>& others) {
  using radiosity::ElementsBy, radiosity::Orientation;
  radiosity::DrawingSettings drawing;
  auto methods = radiosity::namedProjections();
  for (const std::string& other : others) methods.emplace_back(other, radiosity::ProjectionKind::Hemicube);
  assign(drawing.projection, settings.choice("method", methods));
  assign(drawing.resolution, settings.integer("resolution", 2, 4096));
  if (drawing.resolution % 2 != 0)
    throw InputError("`resolution` is " + std::to_string(drawing.resolution), "give an even number");
  assign(drawing.orientation, settings.choice<Orientation>(
                                  "orientation", {{"turned", Orientation::Turned}, {"aligned", Orientation::Aligned}}));
  assign(drawing.split, settings.number("split", 1e-9, 1e300));
  assign(drawing.elementsBy,
         settings.choice<ElementsBy>("elements_by", {{"texture", ElementsBy::Texture}, {"mesh", ElementsBy::Mesh}}));
  return drawing;
}

radiosity::IdSettings idSettings(const Settings& settings) {
  radiosity::IdSettings ids;
  assign(ids.format, settings.text("format"));
  return ids;
}

void addFormFactors(py::module_& module) {
  module.def("form_factor_row", &formFactorRow);
  module.def("form_factor_matrix", &formFactorMatrix);
  module.def("polygon_form_factor", &polygonFormFactor);
  module.def("check_matrix", &checkMatrix);
  module.def("read_matrix", &readMatrix);
  module.def("write_matrix", &writeMatrix);
  module.def("compare_matrices", &compareMatrices);
  module.def("hemicube", &hemicube);
}

}  // namespace hemitex::python
