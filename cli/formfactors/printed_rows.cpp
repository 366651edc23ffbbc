#include "cli/formfactors/printed_rows.h"

#include <iostream>

#include "cli/common/json.h"
#include "cli/scene/source_names.h"
#include "radiosity/scene/surface_names.h"

namespace hemitex::cli {
namespace {

using radiosity::Families;
using reference::OutsideShares;
using reference::RowMethod;
using reference::RowReceivers;
using reference::SparseRow;

/// A source and how it was named.
struct NamedSource {
  std::string name;
  reference::Source source;
};

std::vector<NamedSource> sourcesOf(const FormFactorOptions& options, const radiosity::Scene& scene,
                                   const radiosity::Discretization& discretization) {
  std::vector<NamedSource> sources;
  if (!options.from.empty()) sources.push_back({options.from, sourceNamed(scene, discretization, options.from)});
  for (const std::string& text : options.at)
    for (const NamedPoint& point : pointsNamed(text)) sources.push_back({point.name, {.point = point.point}});
  return sources;
}

/// The table of one row, or of the rows of several sources, which are counted from 1.
Table rowTable(const std::vector<SparseRow>& rows, const radiosity::Scene& scene,
               const radiosity::Discretization& discretization, const Families& families,
               const RowReceivers& receivers) {
  const std::size_t count = receivers.area.size();
  const bool areElements = receivers.ofSurface.empty();
  std::vector<std::string> columns{"surface", "area"};
  if (areElements) columns.insert(columns.begin() + 1, {"column", "row"});
  if (rows.size() > 1) columns.insert(columns.begin(), "source");
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

}  // namespace

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
  const Table table = rowTable(rows, scene, discretization, families, receivers);
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

}  // namespace hemitex::cli
