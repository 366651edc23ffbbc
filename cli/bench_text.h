/// What `hemitex bench` found, for people: the tables of docs/performance.md.
#pragma once

#include <string>

#include "reference/bench_report.h"

namespace hemitex::cli {

/// Markdown. Tables of what was not measured are left out.
std::string benchText(const reference::BenchReport& report);

}  // namespace hemitex::cli
