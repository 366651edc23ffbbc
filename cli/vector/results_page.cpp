#include "cli/vector/results_page.h"

#include <algorithm>

#include "cli/common/base64.h"
#include "reference/base/markup_text.h"
#include "reference/conformance/diagnosis/failure_text.h"
#include "reference/conformance/pictures/verdict_picture.h"

namespace hemitex::cli {
namespace {

using reference::markupText;

constexpr int pictureWidth = 768;  ///< that enlarged pictures may have

constexpr const char* style = R"(<style>
body { font: 16px/1.4 sans-serif; max-width: 72em; margin: 1em auto; padding: 0 1em; }
table { border-collapse: collapse; }
th, td { padding: 0 0.8em 0 0; text-align: right; }
th:nth-child(-n+2), td:nth-child(-n+2) { text-align: left; }
pre { white-space: pre-wrap; }
img { image-rendering: pixelated; max-width: 100%; }
</style>
)";

/// One row of pictures per face, enlarged by a whole number.
std::string pictureOf(const ShownResult& result, const std::filesystem::path& scratch) {
  const auto image = reference::toPicture(result.report.verdict, raster::backgroundId(result.vector.list.format));
  const std::filesystem::path file = scratch / "picture.png";
  radiosity::writePng(file, image);
  const std::string text = base64OfFile(file);
  std::filesystem::remove(file);
  return "<img alt=\"expected, found and verdict\" width=\"" +
         std::to_string(image.width * std::max(1, pictureWidth / image.width)) + "\" src=\"data:image/png;base64," +
         text + "\">\n";
}

/// What is said of a result below the table; empty for a pass.
std::string textOf(const ShownResult& result) {
  if (!hasErrors(result.report.verdict)) return result.remark;
  return result.remark + reference::failureText(result.vector, result.report);
}

std::string rowOf(const ShownResult& result, const std::string& link) {
  const std::string name = markupText(result.report.verdict.vector);
  std::string row = "<tr><td>" + (link.empty() ? name : "<a href=\"#" + link + "\">" + name + "</a>") + "<td>" +
                    nameOf(reference::outcomeNames, outcomeOf(result.report));
  if (!result.report.verdict.faces.empty())
    for (const std::uint64_t count : countVerdicts(result.report.verdict)) row += "<td>" + std::to_string(count);
  return row + "\n";
}

std::string tableHead() {
  std::string head = "<table>\n<tr><th>vector<th>outcome";
  for (const auto& verdict : reference::pixelVerdictNames) head += std::string("<th>") + verdict.name;
  return head + "\n";
}

}  // namespace

std::string toHtml(const ResultsPage& page, const std::filesystem::path& scratch) {
  const std::string title = "Results of " + markupText(page.suite);
  std::string table = tableHead(), sections;
  for (std::size_t k = 0; k < page.results.size(); ++k) {
    const ShownResult& result = page.results[k];
    const std::string text = textOf(result), link = text.empty() ? "" : "vector-" + std::to_string(k);
    table += rowOf(result, link);
    if (text.empty()) continue;
    sections += "<h2 id=\"" + link + "\">" + markupText(result.report.verdict.vector) + "</h2>\n";
    if (hasErrors(result.report.verdict)) sections += pictureOf(result, scratch);
    sections += "<pre>" + markupText(text, true) + "</pre>\n";
  }
  return "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>" + title + "</title>\n" + style +
         "<h1>" + title + "</h1>\n" +
         (page.diagnosis.empty() ? "" : "<p>Diagnosis: " + markupText(page.diagnosis) + "</p>\n") + table +
         "</table>\n<p>Pictures show expected item IDs, found item IDs and verdicts: grey exact, blue coverage, green "
         "texel, yellow depth, violet loose clipping, red error.</p>\n" +
         sections;
}

}  // namespace hemitex::cli
