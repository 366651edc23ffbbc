/// What `hemitex bench` found, for people: tables as docs/performance.md has them.
#pragma once

#include <string>
#include <vector>

#include "reference/bench_runs.h"

namespace hemitex::cli {

/// A line for each scene, number of triangles and resolution: milliseconds, and behind them how many times the
/// hemicube's.
std::string runsTable(const std::vector<reference::BenchRun>& runs);

}  // namespace hemitex::cli
