#include "cli/bench/plots.h"

#include <map>
#include <set>

namespace hemitex::cli {

using namespace reference;

namespace {

Plot trianglesPlot(const std::vector<BenchRun>& runs, const std::string& scene, int resolution) {
  Plot plot{scene, scene + ", R = " + std::to_string(resolution), "triangles", "ms a hemicube", {}};
  for (const char* what : {"hemicube", "embree", "opengl", "floor"}) {
    Curve curve{what, {}, std::string(what) == "floor"};
    for (const BenchRun& run : runs)
      if (run.scene == scene && run.resolution == resolution && run.what == what)
        curve.points.emplace_back(static_cast<double>(run.triangles), 1000 * run.seconds.median);
    if (!curve.points.empty()) plot.curves.push_back(curve);
  }
  return plot;
}

}  // namespace

std::vector<Plot> trianglesPlots(const std::vector<BenchRun>& runs) {
  std::set<int> resolutions;
  std::map<std::string, std::set<std::size_t>> triangles;
  for (const BenchRun& run : runs) {
    resolutions.insert(run.resolution);
    triangles[run.scene].insert(run.triangles);
  }
  std::vector<Plot> plots;
  for (const auto& [scene, counts] : triangles) {
    if (counts.size() > 1) plots.push_back(trianglesPlot(runs, scene, *resolutions.rbegin()));
  }
  return plots;
}

Plot growthPlot(const std::vector<BenchGrowth>& growth) {
  Plot plot{"growth",
            "A hemicube of R = " + std::to_string(growth.front().resolution) + " as elements grow finer",
            "elements along the side of every surface",
            "ms",
            {}};
  for (const BenchGrowth& of : growth) {
    Curve draw{of.scene + ", drawn", {}}, row{of.scene + ", row", {}, true};
    for (const GrowthPoint& point : of.points) {
      draw.points.emplace_back(point.side, 1000 * point.draw.median);
      row.points.emplace_back(point.side, 1000 * point.row.median);
    }
    plot.curves.insert(plot.curves.end(), {draw, row});
  }
  return plot;
}

}  // namespace hemitex::cli
