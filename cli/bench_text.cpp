#include "cli/bench_text.h"

#include <iomanip>
#include <map>
#include <sstream>

namespace hemitex::cli {
namespace {

const std::vector<std::string> columns{"hemicube", "draw",          "floor", "embree",
                                       "opengl",   "hemicube-mesh", "shot",  "solution"};

std::string rounded(double value, int digits) {
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

/// Milliseconds of what was run; in brackets, over those of a hemicube.
std::string cell(const std::map<std::string, double>& medians, const std::string& what) {
  const auto found = medians.find(what);
  if (found == medians.end()) return "";
  const std::string text = rounded(1000 * found->second, 3);
  if (what == "hemicube") return text;
  return text + " (" + rounded(found->second / medians.at("hemicube"), 2) + ")";
}

}  // namespace

std::string runsTable(const std::vector<reference::BenchRun>& runs) {
  std::ostringstream text;
  text << "| scene | triangles | elements | R |";
  for (const std::string& what : columns) text << ' ' << what << " |";
  text << "\n|---|---|---|---|";
  for (std::size_t k = 0; k < columns.size(); ++k) text << "---|";
  text << '\n';
  const auto place = [](const reference::BenchRun& run) {
    return std::make_tuple(run.scene, run.triangles, run.resolution);
  };
  for (std::size_t first = 0, end = 0; first < runs.size(); first = end) {
    std::map<std::string, double> medians;
    for (; end < runs.size() && place(runs[end]) == place(runs[first]); ++end)
      medians[runs[end].what] = runs[end].seconds.median;
    const reference::BenchRun& run = runs[first];
    text << "| " << run.scene << " | " << run.triangles << " | " << run.elements << " | " << run.resolution << " |";
    for (const std::string& what : columns) text << ' ' << cell(medians, what) << " |";
    text << '\n';
  }
  return text.str();
}

}  // namespace hemitex::cli
