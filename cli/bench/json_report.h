/// What `hemitex bench` found, as JSON.
#pragma once

#include "cli/common/json.h"
#include "reference/bench/report.h"

namespace hemitex::cli {

/// `runs`, and what else was measured: `two_cores`, `tied_wall`, `growth`, `solution_parts`, `memory` and
/// `equal_time_error`, empty where it was not; `crossover` and `requirements`.
nlohmann::ordered_json toJson(const reference::BenchReport& report);

}  // namespace hemitex::cli
