/// What `hemitex bench` found, as JSON and as text.
#pragma once

#include "cli/common/json.h"
#include "reference/bench/report.h"

namespace hemitex::cli {

/// `runs` and, over the hemicube's, their `ratios`; what else was measured: `two_cores`, `tied_wall`, `growth`,
/// `solution_parts`, `memory` and `equal_time_error`, empty where it was not; and `crossover`.
nlohmann::ordered_json toJson(const reference::BenchReport& report);

/// The tables of the object that toJson makes, in Markdown.
std::string benchText(const nlohmann::ordered_json& result);

}  // namespace hemitex::cli
