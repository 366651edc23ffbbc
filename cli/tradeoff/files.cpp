#include "cli/tradeoff/files.h"

#include <sstream>

#include "cli/common/json.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;
using reference::TradeMeasurement;

ordered_json toJson(const reference::RowError& error) {
  return {{"relative_l1", error.relativeL1}, {"rms", error.rms}, {"maximum", error.maximum}};
}

ordered_json toJson(const reference::RadiosityError& error) {
  return {{"flux_weighted", error.fluxWeighted}, {"rms", error.rms}, {"maximum", error.maximum}};
}

ordered_json toJson(const Tradeoff& tradeoff, const TradeMeasurement& measurement) {
  const reference::TradeChoice& choice = measurement.choice;
  const reference::TradeMethod& method = tradeoff.methods[choice.method];
  return {
      {"method", method.name},
      {"setting", method.setting},
      {"value", choice.setting},
      {"directions", method.directions(choice.setting)},
      {"texels", choice.texels},
      {"patch", choice.patch},
      {"elements", measurement.elements},
      {"patches", measurement.patches},
      {"rows", measurement.rows},
      {"shots", measurement.shots},
      {"row_error", toJson(measurement.rowError)},
      {"radiosity_error", toJson(measurement.error)},
      {"bytes",
       {{"buffer", measurement.bufferBytes}, {"rows", measurement.rowBytes}, {"elements", measurement.elementBytes}}},
      {"times",
       {{"median_s", measurement.seconds.median},
        {"rounds_s", measurement.seconds.repetitions},
        {"pareto", measurement.isOnFront}}}};
}

ordered_json toJson(const std::vector<reference::RowQuality>& qualities) {
  return listOf(qualities, [](const reference::RowQuality& quality) -> ordered_json {
    return {{"size", quality.size}, {"error", quality.error}, {"times", {{"row_s", quality.seconds}}}};
  });
}

/// The qualities of hemicubes, each with the error of rays in the same time.
ordered_json toJson(const std::vector<reference::RowQuality>& hemicubes,
                    const std::vector<reference::RowQuality>& rays) {
  ordered_json list = toJson(hemicubes);
  for (std::size_t i = 0; i < hemicubes.size(); ++i) {
    const std::optional<double> error = reference::errorAtTime(rays, hemicubes[i].seconds);
    list[i]["times"]["error_of_rays"] = error ? ordered_json(*error) : ordered_json();
  }
  return list;
}

ordered_json toJson(const reference::RowComparison& comparison) {
  return {{"points", comparison.patches.size()},
          {"truth_error", comparison.truthError},
          {"hemicubes", toJson(comparison.hemicubes, comparison.rays)},
          {"turned_hemicubes", toJson(comparison.turnedHemicubes, comparison.rays)},
          {"rays", toJson(comparison.rays)}};
}

/// The bounds on the error of the table of fastest choices.
constexpr double errorLevels[] = {0.1, 0.05, 0.03, 0.02, 0.01};

/// The fastest choice with at most this error; nothing if every choice has a larger error.
std::optional<std::size_t> fastestWithin(const Tradeoff& tradeoff, double error) {
  std::optional<std::size_t> fastest;
  for (std::size_t i = 0; i < tradeoff.measurements.size(); ++i) {
    const TradeMeasurement& measurement = tradeoff.measurements[i];
    if (measurement.error.fluxWeighted > error) continue;
    if (!fastest || measurement.seconds.median < tradeoff.measurements[*fastest].seconds.median) fastest = i;
  }
  return fastest;
}

}  // namespace

ordered_json toJson(const Tradeoff& tradeoff) {
  const auto choice = [&](const TradeMeasurement& measurement) { return toJson(tradeoff, measurement); };
  const auto within = [&](double level) -> ordered_json {
    const std::optional<std::size_t> fastest = fastestWithin(tradeoff, level);
    return {{"error", level}, {"choice", fastest ? ordered_json(*fastest) : ordered_json()}};
  };
  return {{"truth",
           {{"elements", tradeoff.fine.elements.size()},
            {"radiosity_error", toJson(tradeoff.truth.error)},
            {"row_error", toJson(tradeoff.truthRowError)}}},
          {"choices", listOf(tradeoff.measurements, choice)},
          {"same_points", tradeoff.samePoints ? toJson(*tradeoff.samePoints) : ordered_json()},
          {"times", {{"within", listOf(errorLevels, within)}}}};
}

Table choiceTable(const ordered_json& choices) {
  Table table = tableOf(choices);
  table.columns = {"method",
                   "setting",
                   "value",
                   "directions",
                   "texels",
                   "patch",
                   "elements",
                   "patches",
                   "rows",
                   "shots",
                   "row_relative_l1",
                   "row_rms",
                   "row_maximum",
                   "radiosity_flux_weighted",
                   "radiosity_rms",
                   "radiosity_maximum",
                   "buffer_bytes",
                   "row_bytes",
                   "element_bytes",
                   "median_s",
                   "rounds",
                   "pareto"};
  return table;
}

std::string tradeoffText(const ordered_json& result) {
  const auto row = [&result](const ordered_json& level) {
    ordered_json cells{{"error at most", level["error"]}};
    if (level["choice"].is_null()) return cells;
    const ordered_json& choice = result["choices"][level["choice"].get<std::size_t>()];
    for (const char* key : {"method", "setting", "value", "texels", "patch"}) cells[key] = choice[key];
    cells.update({{"seconds", choice["times"]["median_s"]}, {"error", choice["radiosity_error"]["flux_weighted"]}});
    return cells;
  };
  ordered_json rows = listOf(result["times"]["within"], row);
  rows.push_back({{"error at most", "statistical error of the truth"},
                  {"error", result["truth"]["radiosity_error"]["flux_weighted"]}});
  std::ostringstream text;
  writeMarkdown(text, "Fastest choice for each bound on the error:", rows);
  return text.str();
}

}  // namespace hemitex::cli
