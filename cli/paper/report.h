/// What `hemitex paper` found, as JSON, text and page: the runs, the paper's own figures beside them, and their ratios.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/common/json.h"
#include "reference/paper/runs.h"

namespace hemitex::cli {

/// An object with the lists `runs`, `speed_ups` and `growth`. The paper's figures stand under `paper`, and are null
/// where it has none or the text lost them.
nlohmann::ordered_json paperJson(const std::vector<reference::PaperRun>& runs);

/// The tables of this object, in Markdown.
std::string paperText(const nlohmann::ordered_json& result);

/// The page of this object, which has the lists `phantoms` and `figures` as well (figures.h). The files of the figures
/// lie in `folder`.
std::string paperPage(nlohmann::ordered_json result, const std::filesystem::path& folder);

}  // namespace hemitex::cli
