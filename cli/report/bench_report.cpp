#include "cli/report/bench_report.h"

#include <sstream>

#include "cli/common/table.h"
#include "reference/measurement/bench/render_times.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

ordered_json runJson(const reference::BenchRun& run) {
  constexpr double milliseconds = 1000;
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

/// One row per scene and resolution, and one column per `what`.
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

}  // namespace

ordered_json benchJson(const std::vector<reference::BenchRun>& runs) {
  ordered_json ratios = ordered_json::array();
  for (const reference::BenchRun& run : runs)
    if (const std::optional<double> ratio = overHemicube(run, runs))
      ratios.push_back({{"scene", run.scene},
                        {"triangles", run.triangles},
                        {"resolution", run.resolution},
                        {"what", run.what},
                        {"over_hemicube", *ratio}});
  return {{"runs", listOf(runs, runJson)}, {"ratios", ratios}};
}

std::string benchText(const ordered_json& result) {
  std::ostringstream text;
  writeMarkdown(text, "Times in milliseconds:", byPlace(result["runs"], "median_ms"));
  writeMarkdown(text, "Times over that of the hemicube:", byPlace(result["ratios"], "over_hemicube"));
  return text.str();
}

}  // namespace hemitex::cli
