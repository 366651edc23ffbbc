#include "cli/bench/tables.h"

#include <cmath>
#include <iomanip>
#include <map>
#include <sstream>
#include <tuple>

namespace hemitex::cli {
namespace {

using namespace reference;

/// To so many digits, but all of them before the point.
std::string rounded(double value, int digits = 3) {
  if (value >= std::pow(10, digits)) return std::to_string(std::llround(value));
  std::ostringstream text;
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string inMilliseconds(const Timing& timing) { return rounded(1000 * timing.median); }

/// A table: a line for its head, one for each row.
class Table {
 public:
  explicit Table(const std::vector<std::string>& head) {
    add(head);
    for (std::size_t k = 0; k < head.size(); ++k) text_ << "|---";
    text_ << "|\n";
  }
  void add(const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) text_ << "| " << cell << ' ';
    text_ << "|\n";
  }
  std::string text() const { return text_.str() + '\n'; }

 private:
  std::ostringstream text_;
};

/// Milliseconds of what was run; in brackets, over those of a hemicube, but for solutions: they choose other patches.
std::string runCell(const std::map<std::string, Timing>& timings, const std::string& what) {
  const auto found = timings.find(what);
  if (found == timings.end()) return "";
  const std::string text = inMilliseconds(found->second);
  if (what == "hemicube" || what == "shot" || what == "solution") return text;
  return text + " (" + rounded(ratioOf(found->second, timings.at("hemicube")), 2) + ")";
}

/// A line for each scene, number of triangles and resolution.
std::string runsText(const std::vector<BenchRun>& runs) {
  const std::vector<std::string> columns{"hemicube", "draw",          "floor", "embree",
                                         "opengl",   "hemicube-mesh", "shot",  "solution"};
  std::vector<std::string> head{"scene", "triangles", "elements", "R"};
  head.insert(head.end(), columns.begin(), columns.end());
  Table table(head);
  const auto place = [](const BenchRun& run) { return std::make_tuple(run.scene, run.triangles, run.resolution); };
  for (std::size_t first = 0, end = 0; first < runs.size(); first = end) {
    std::map<std::string, Timing> timings;
    for (; end < runs.size() && place(runs[end]) == place(runs[first]); ++end)
      timings[runs[end].what] = runs[end].seconds;
    const BenchRun& run = runs[first];
    std::vector<std::string> cells{run.scene, std::to_string(run.triangles), std::to_string(run.elements),
                                   std::to_string(run.resolution)};
    for (const std::string& what : columns) cells.push_back(runCell(timings, what));
    table.add(cells);
  }
  return "Milliseconds; in brackets, over those of a hemicube.\n\n" + table.text();
}

std::string crossoverText(const std::vector<BenchRun>& runs) {
  Table table({"scene", "R", "triangles from which Embree is faster"});
  for (const Crossover& crossover : crossovers(runs))
    table.add({crossover.scene, std::to_string(crossover.resolution),
               crossover.triangles ? rounded(*crossover.triangles, 2) : "none"});
  return table.text();
}

std::string growthText(const std::vector<BenchGrowth>& growth) {
  Table table({"scene", "R", "elements along a side", "elements", "draw, ms", "row, ms"});
  for (const BenchGrowth& of : growth)
    for (const GrowthPoint& point : of.points)
      table.add({of.scene, std::to_string(of.resolution), std::to_string(point.side), std::to_string(point.elements),
                 inMilliseconds(point.draw), inMilliseconds(point.row)});
  return table.text();
}

std::string errorText(const std::vector<EqualTimeError>& errors) {
  Table table({"scene", "R", "ms", "error of the hemicube's row", "of rays", "ratio"});
  for (const EqualTimeError& error : errors)
    table.add({error.scene, std::to_string(error.resolution), rounded(1000 * error.seconds), rounded(error.hemicube),
               rounded(error.rays), rounded(error.hemicube / error.rays, 2)});
  return table.text();
}

std::string wallText(const std::vector<WallTimes>& walls) {
  Table table({"R", "tied, ms", "moved, ms", "ratio"});
  for (const WallTimes& wall : walls)
    table.add({std::to_string(wall.resolution), inMilliseconds(wall.tied), inMilliseconds(wall.moved),
               rounded(ratioOf(wall.tied, wall.moved))});
  return table.text();
}

std::string coresText(const CoreGains& gains) {
  Table table({"on two threads", "times faster", "of what arithmetic gains"});
  table.add({"arithmetic", rounded(gains.arithmetic), "1"});
  table.add({"hemicube", rounded(gains.hemicube), rounded(gains.hemicubeOfArithmetic)});
  table.add({"solution", rounded(gains.solution), rounded(gains.solutionOfArithmetic)});
  return table.text();
}

/// A line for each resolution.
std::string partsText(const std::vector<SolutionParts>& solutions) {
  Table table({"elements", "shots", "R", "solution, ms", "hemicubes, percent", "start", "picking the next patch",
               "spreading the light", "accounting"});
  for (const SolutionParts& parts : solutions) {
    std::vector<std::string> cells{std::to_string(parts.elements), std::to_string(parts.shots),
                                   std::to_string(parts.resolution), rounded(1000 * parts.total())};
    for (const double seconds : {parts.hemicubes, parts.start, parts.picking, parts.spreading, parts.accounting})
      cells.push_back(rounded(100 * seconds / parts.total()));
    table.add(cells);
  }
  return table.text();
}

std::string memoryText(const SolutionMemory& memory) {
  return rounded(memory.bytesPerElement) + " bytes an element and " + rounded(memory.bytesPerPixel) +
         " bytes a pixel above the scene; " + rounded(static_cast<double>(memory.peakBytes) / 1e6) +
         " MB at most in all of this run\n\n";
}

std::string requirementsText(const std::vector<Requirement>& requirements) {
  Table table({"what", "measured", "limit", "kept"});
  for (const Requirement& requirement : requirements)
    table.add({requirement.what, rounded(requirement.measured), rounded(requirement.limit),
               requirement.isKept ? "yes" : "NO"});
  return table.text();
}

}  // namespace

std::string benchText(const BenchReport& report) {
  std::string text = runsText(report.runs) + crossoverText(report.runs);
  if (!report.errors.empty()) text += errorText(report.errors);
  if (!report.growth.empty()) text += growthText(report.growth);
  if (!report.walls.empty()) text += wallText(report.walls);
  if (report.cores) text += coresText(*report.cores);
  if (!report.parts.empty()) text += partsText(report.parts);
  if (report.memory) text += memoryText(*report.memory);
  if (!report.requirements.empty()) text += requirementsText(report.requirements);
  return text;
}

}  // namespace hemitex::cli
