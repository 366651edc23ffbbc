/// What `hemitex bench` found, for people: the tables of docs/performance.md.
#pragma once

#include <string>

#include "reference/bench/report.h"

namespace hemitex::cli {

/// Markdown. Tables of what was not measured are left out.
std::string benchText(const reference::BenchReport& report);

}  // namespace hemitex::cli
