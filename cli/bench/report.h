/// Writes the measurements of `hemitex bench` as JSON and Markdown.
#pragma once

#include "cli/common/json.h"
#include "reference/measurement/bench/report.h"

namespace hemitex::cli {

/// An object with `runs`, their `ratios` over the hemicube, and `crossover`. The other measurements are `two_cores`,
/// `tied_wall`, `growth`, `solution_parts`, `memory` and `equal_time_error`; empty if they were not made.
nlohmann::ordered_json toJson(const reference::BenchReport& report);

/// The tables of this object in Markdown.
std::string benchText(const nlohmann::ordered_json& result);

}  // namespace hemitex::cli
