#include "cli/bench/report.h"

#include <sstream>

#include "cli/common/table.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

constexpr double milliseconds = 1000;

ordered_json runJson(const reference::BenchRun& run) {
  return {{"scene", run.scene},
          {"triangles", run.triangles},
          {"elements", run.elements},
          {"resolution", run.resolution},
          {"threads", run.threads},
          {"what", run.what},
          {"median_ms", run.seconds.median * milliseconds},
          {"min_ms", run.seconds.min * milliseconds},
          {"repeats", run.seconds.repetitions.size()}};
}

ordered_json ratioJson(const reference::BenchRatio& ratio) {
  return {{"scene", ratio.scene},
          {"triangles", ratio.triangles},
          {"resolution", ratio.resolution},
          {"what", ratio.what},
          {"over_hemicube", ratio.overHemicube}};
}

ordered_json coresJson(const reference::CoreGains& gains) {
  return {{"arithmetic", gains.arithmetic},
          {"hemicube", gains.hemicube},
          {"solution", gains.solution},
          {"hemicube_of_arithmetic", gains.hemicubeOfArithmetic},
          {"solution_of_arithmetic", gains.solutionOfArithmetic}};
}

ordered_json wallJson(const reference::WallTimes& wall) {
  return {{"resolution", wall.resolution},
          {"tied_ms", wall.tied.median * milliseconds},
          {"moved_ms", wall.moved.median * milliseconds},
          {"ratio", ratioOf(wall.tied, wall.moved)}};
}

ordered_json growthJson(const reference::BenchGrowth& growth) {
  const auto pointJson = [](const reference::GrowthPoint& point) -> ordered_json {
    return {{"side", point.side},
            {"elements", point.elements},
            {"draw_ms", point.draw.median * milliseconds},
            {"row_ms", point.row.median * milliseconds}};
  };
  return {{"scene", growth.scene}, {"resolution", growth.resolution}, {"points", listOf(growth.points, pointJson)}};
}

ordered_json partsJson(const reference::SolutionParts& parts) {
  const double percent = 100 / parts.total();
  return {{"elements", parts.elements},
          {"resolution", parts.resolution},
          {"shots", parts.shots},
          {"total_ms", parts.total() * milliseconds},
          {"beside_percent", 100 * parts.besideOfTotal},
          {"percent",
           {{"hemicubes", parts.hemicubes * percent},
            {"start", parts.start * percent},
            {"picking", parts.picking * percent},
            {"spreading", parts.spreading * percent},
            {"accounting", parts.accounting * percent}}}};
}

ordered_json memoryJson(const reference::SolutionMemory& memory) {
  return {{"bytes_per_element", memory.bytesPerElement},
          {"bytes_per_pixel", memory.bytesPerPixel},
          {"peak_bytes", memory.peakBytes}};
}

ordered_json errorJson(const reference::EqualTimeError& error) {
  return {{"scene", error.scene},
          {"resolution", error.resolution},
          {"time_ms", error.seconds * milliseconds},
          {"hemicube", error.hemicube},
          {"rays", error.rays},
          {"ratio", error.hemicube / error.rays}};
}

ordered_json crossoverJson(const reference::Crossover& crossover) {
  ordered_json result{{"scene", crossover.scene}, {"resolution", crossover.resolution}, {"triangles", nullptr}};
  if (crossover.triangles) result["triangles"] = *crossover.triangles;
  return result;
}

/// One row per scene, number of triangles and resolution, and one column per `what`.
ordered_json byPlace(const ordered_json& list, const std::string& value) {
  ordered_json rows = ordered_json::array();
  ordered_json last;
  for (const ordered_json& item : list) {
    ordered_json place;
    for (const char* key : {"scene", "triangles", "elements", "resolution"})
      if (item.contains(key)) place[key] = item[key];
    if (place != last) rows.push_back(last = place);
    rows.back()[item["what"].get<std::string>()] = item[value];
  }
  return rows;
}

/// One row per point.
ordered_json growthRows(const ordered_json& growth) {
  ordered_json rows = ordered_json::array();
  for (const ordered_json& of : growth)
    for (const ordered_json& point : of["points"]) {
      rows.push_back({{"scene", of["scene"]}, {"resolution", of["resolution"]}});
      rows.back().update(point);
    }
  return rows;
}

}  // namespace

ordered_json toJson(const reference::BenchReport& report) {
  return {{"runs", listOf(report.runs, runJson)},
          {"two_cores", report.cores ? coresJson(*report.cores) : ordered_json::object()},
          {"tied_wall", listOf(report.walls, wallJson)},
          {"growth", listOf(report.growth, growthJson)},
          {"solution_parts", listOf(report.parts, partsJson)},
          {"memory", report.memory ? memoryJson(*report.memory) : ordered_json::object()},
          {"equal_time_error", listOf(report.errors, errorJson)},
          {"crossover", listOf(reference::crossovers(report.runs), crossoverJson)},
          {"ratios", listOf(reference::benchRatios(report.runs), ratioJson)}};
}

std::string benchText(const ordered_json& result) {
  std::ostringstream text;
  const auto add = [&text](const std::string& title, const ordered_json& list) { writeMarkdown(text, title, list); };
  add("Times in milliseconds:", byPlace(result["runs"], "median_ms"));
  add("Times over that of the hemicube:", byPlace(result["ratios"], "over_hemicube"));
  add("Number of triangles from which Embree is faster:", result["crossover"]);
  add("Errors of rows by hemicubes and by rays in the same time:", result["equal_time_error"]);
  add("Times of a hemicube in milliseconds, by the number of elements along the side of each surface:",
      growthRows(result["growth"]));
  add("Exact arithmetic: a wall whose texel borders lie on samples, and the same wall moved by a third of a pixel:",
      result["tied_wall"]);
  add("Speed-up on two threads:", result["two_cores"]);
  add("Parts of the time of a solution:", result["solution_parts"]);
  add("Memory of a solution without the scene (the peak is that of the process):", result["memory"]);
  return text.str();
}

}  // namespace hemitex::cli
