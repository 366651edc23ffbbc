#include "cli/report/paper_report.h"

#include <sstream>

#include "cli/common/base64.h"
#include "cli/common/table.h"
#include "cli/report/embedded_files.h"
#include "cli/report/html_page.h"
#include "reference/measurement/paper/tables.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

ordered_json paperRunJson(const reference::PaperRun& run) {
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

ordered_json ratioJson(const reference::PaperRatio& ratio, const std::string& key, const std::string& value) {
  return {{"scene", ratio.run.scene},
          {"device", ratio.run.device},
          {key, value},
          {"resolution", ratio.run.resolution},
          {"total", ratio.ratio.total},
          {"form_factor", ratio.ratio.formFactors},
          {"draw", ratio.ratio.draw},
          {"paper", {{"total", orNull(ratio.published.total)}, {"form_factor", orNull(ratio.published.formFactors)}}}};
}

}  // namespace

ordered_json paperJson(const std::vector<reference::PaperRun>& runs) {
  using reference::PaperRatio;
  const auto speedUp = [](const PaperRatio& ratio) { return ratioJson(ratio, "level", ratio.run.level); };
  const auto growth = [](const PaperRatio& ratio) { return ratioJson(ratio, "discretize", ratio.run.discretize); };
  return {{"runs", listOf(runs, paperRunJson)},
          {"speed_ups", listOf(reference::speedUps(runs), speedUp)},
          {"growth", listOf(reference::growths(runs), growth)}};
}

std::string paperText(const ordered_json& result) {
  std::ostringstream text;
  writeMarkdown(text, "Times of solutions in seconds, and those of the paper:", result["runs"]);
  writeMarkdown(text,
                "Time of regular meshing over that of textures, and the same ratio of the paper:", result["speed_ups"]);
  writeMarkdown(
      text, "Time of the fine level over that of the coarse level, and the same ratio of the paper:", result["growth"]);
  return text.str();
}

std::string paperPage(ordered_json result, const std::filesystem::path& folder) {
  for (auto& figure : result.at("figures")) figure["png"] = base64OfFile(folder / figure.at("file").get<std::string>());
  return completePage(paperPageText, result);
}

}  // namespace hemitex::cli
