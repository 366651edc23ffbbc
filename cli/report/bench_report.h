/// Writes the measurements of `hemitex bench` as JSON and Markdown.
#pragma once

#include <string>
#include <vector>

#include "cli/common/json.h"

namespace hemitex::reference {
struct BenchRun;
}

namespace hemitex::cli {

/// An object with the list `runs`, and the list `ratios` of their times over that of the hemicube (overHemicube).
nlohmann::ordered_json benchJson(const std::vector<reference::BenchRun>& runs);

/// The tables of this object in Markdown.
std::string benchText(const nlohmann::ordered_json& result);

}  // namespace hemitex::cli
