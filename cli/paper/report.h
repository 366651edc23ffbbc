/// paper.json: the runs, the paper's own figures beside them, and what both say.
#pragma once

#include <vector>

#include "cli/common/json.h"
#include "reference/paper/runs.h"

namespace hemitex::cli {

/// An object with the lists `runs`, `speed_ups` and `growth`. The paper's figures stand under `paper`, and
/// are null where it has none or the text lost them.
nlohmann::ordered_json paperJson(const std::vector<reference::PaperRun>& runs);

}  // namespace hemitex::cli
