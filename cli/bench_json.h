/// What `hemitex bench` found, as JSON.
#pragma once

#include <vector>

#include "cli/json.h"
#include "reference/bench_runs.h"

namespace hemitex::cli {

nlohmann::ordered_json toJson(const std::vector<reference::BenchRun>& runs);

}  // namespace hemitex::cli
