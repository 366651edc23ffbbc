#include "cli/bench/json_report.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

constexpr double milliseconds = 1000;

/// A list of what `make` makes of each.
template <typename List, typename Make>
ordered_json listOf(const List& list, const Make& make) {
  ordered_json result = ordered_json::array();
  for (const auto& item : list) result.push_back(make(item));
  return result;
}

ordered_json runJson(const reference::BenchRun& run) {
  return {{"scene", run.scene},
          {"triangles", run.triangles},
          {"elements", run.elements},
          {"resolution", run.resolution},
          {"threads", run.threads},
          {"what", run.what},
          {"median_ms", run.seconds.median * milliseconds},
          {"min_ms", run.seconds.least * milliseconds},
          {"repeats", run.seconds.turns.size()}};
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

ordered_json requirementJson(const reference::Requirement& requirement) {
  return {{"what", requirement.what},
          {"measured", requirement.measured},
          {"limit", requirement.limit},
          {"kept", requirement.isKept}};
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
          {"requirements", listOf(report.requirements, requirementJson)}};
}

}  // namespace hemitex::cli
