#include "cli/tradeoff/files.h"

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
       {{"median_s", reference::seconds(measurement)},
        {"rounds_s", measurement.seconds},
        {"pareto", measurement.isOnFront}}}};
}

ordered_json toJson(const std::vector<reference::RowQuality>& qualities) {
  ordered_json list = ordered_json::array();
  for (const reference::RowQuality& quality : qualities)
    list.push_back({{"size", quality.size}, {"error", quality.error}, {"times", {{"row_s", quality.seconds}}}});
  return list;
}

/// Hemicubes beside the error of rays in the same time.
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

}  // namespace

std::optional<std::size_t> fastestWithin(const Tradeoff& tradeoff, double error) {
  std::optional<std::size_t> fastest;
  for (std::size_t i = 0; i < tradeoff.measurements.size(); ++i) {
    const TradeMeasurement& measurement = tradeoff.measurements[i];
    if (measurement.error.fluxWeighted > error) continue;
    if (!fastest || reference::seconds(measurement) < reference::seconds(tradeoff.measurements[*fastest])) fastest = i;
  }
  return fastest;
}

std::string nameOf(const Tradeoff& tradeoff, const TradeMeasurement& measurement) {
  const reference::TradeChoice& choice = measurement.choice;
  const reference::TradeMethod& method = tradeoff.methods[choice.method];
  return method.name + ", " + method.setting + ' ' + std::to_string(choice.setting) + ", " +
         std::to_string(choice.texels) + " texels, patches of " + std::to_string(choice.patch);
}

ordered_json toJson(const Tradeoff& tradeoff) {
  ordered_json choices = ordered_json::array(), within = ordered_json::array();
  for (const TradeMeasurement& measurement : tradeoff.measurements) choices.push_back(toJson(tradeoff, measurement));
  for (const double level : errorLevels) {
    const std::optional<std::size_t> fastest = fastestWithin(tradeoff, level);
    within.push_back({{"error", level}, {"choice", fastest ? ordered_json(*fastest) : ordered_json()}});
  }
  return {{"truth",
           {{"elements", tradeoff.fine.elements.size()},
            {"radiosity_error", toJson(tradeoff.truth.error)},
            {"row_error", toJson(tradeoff.truthRowError)}}},
          {"choices", std::move(choices)},
          {"same_points", tradeoff.samePoints ? toJson(*tradeoff.samePoints) : ordered_json()},
          {"times", {{"within", std::move(within)}}}};
}

Table choiceTable(const Tradeoff& tradeoff) {
  const auto row = [&tradeoff](std::size_t index) -> std::vector<Cell> {
    const auto count = [](std::size_t value) { return static_cast<std::int64_t>(value); };
    const TradeMeasurement& m = tradeoff.measurements[index];
    const reference::TradeMethod& method = tradeoff.methods[m.choice.method];
    return {method.name,
            method.setting,
            std::int64_t{m.choice.setting},
            method.directions(m.choice.setting),
            std::int64_t{m.choice.texels},
            std::int64_t{m.choice.patch},
            count(m.elements),
            count(m.patches),
            count(m.rows),
            std::int64_t{m.shots},
            m.rowError.relativeL1,
            m.rowError.rms,
            m.rowError.maximum,
            m.error.fluxWeighted,
            m.error.rms,
            m.error.maximum,
            count(m.bufferBytes),
            count(m.rowBytes),
            count(m.elementBytes),
            reference::seconds(m),
            count(m.seconds.size()),
            std::int64_t{m.isOnFront}};
  };
  return {{"method",
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
           "pareto"},
          tradeoff.measurements.size(),
          row};
}

}  // namespace hemitex::cli
