#include "cli/paper/report.h"

#include <optional>

#include "reference/paper/tables.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

ordered_json orNull(const std::optional<double>& value) { return value ? ordered_json(*value) : ordered_json(); }

ordered_json runJson(const reference::PaperRun& run) {
  const auto published = reference::publishedTimes(run).value_or(reference::PublishedTimes{});
  return {{"scene", run.scene},
          {"triangles", run.triangles},
          {"device", run.device},
          {"discretize", run.discretize},
          {"level", run.level},
          {"resolution", run.resolution},
          {"elements", run.elements},
          {"shots", run.shots},
          {"total_s", run.seconds.total},
          {"form_factor_s", run.seconds.formFactors},
          {"draw_s", run.seconds.draw},
          {"paper", {{"total_s", orNull(published.total)}, {"form_factor_s", orNull(published.formFactors)}}}};
}

/// The ratios of a speed-up or a growth, behind what says which it is.
template <typename Ratios>
ordered_json ratioJson(ordered_json result, const Ratios& ratios) {
  result.update(
      {{"resolution", ratios.resolution},
       {"total", ratios.total},
       {"form_factor", ratios.formFactors},
       {"draw", ratios.draw},
       {"paper", {{"total", orNull(ratios.published.total)}, {"form_factor", orNull(ratios.published.formFactors)}}}});
  return result;
}

}  // namespace

ordered_json paperJson(const std::vector<reference::PaperRun>& runs) {
  ordered_json result{{"runs", ordered_json::array()},
                      {"speed_ups", ordered_json::array()},
                      {"growth", ordered_json::array()},
                      {"promises", ordered_json::array()}};
  for (const reference::PaperRun& run : runs) result["runs"].push_back(runJson(run));
  for (const reference::SpeedUp& s : reference::speedUps(runs))
    result["speed_ups"].push_back(ratioJson({{"scene", s.scene}, {"device", s.device}, {"level", s.level}}, s));
  for (const reference::Growth& g : reference::growths(runs))
    result["growth"].push_back(ratioJson({{"scene", g.scene}, {"device", g.device}, {"discretize", g.discretize}}, g));
  for (const reference::Promise& promise : reference::promises(runs))
    result["promises"].push_back(
        {{"what", promise.what}, {"measured", promise.measured}, {"limit", promise.limit}, {"kept", promise.isKept}});
  return result;
}

}  // namespace hemitex::cli
