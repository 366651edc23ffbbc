/// The curves of `hemitex bench`: what triangles cost, and what elements cost.
#pragma once

#include "cli/bench/svg_plot.h"
#include "reference/bench/report.h"

namespace hemitex::cli {

/// Milliseconds over the triangles that a scene is cut into, at the highest resolution: a plot for every scene that
/// was cut.
std::vector<Plot> trianglesPlots(const std::vector<reference::BenchRun>& runs);

/// Milliseconds over the elements along a surface's side: of drawing, and of the sum of the row. Not of nothing.
Plot growthPlot(const std::vector<reference::BenchGrowth>& growth);

}  // namespace hemitex::cli
