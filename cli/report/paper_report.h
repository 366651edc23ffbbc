/// Writes the runs of `hemitex paper` and their ratios, beside the values of the paper, as JSON, Markdown and HTML.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/common/json.h"

namespace hemitex::reference {
struct PaperRun;
}

namespace hemitex::cli {

/// An object with the lists `runs`, `speed_ups` and `growth`. The values of the paper are under `paper`; they are null
/// if the paper has none or if they are illegible in our copy.
nlohmann::ordered_json paperJson(const std::vector<reference::PaperRun>& runs);

/// The tables of this object in Markdown.
std::string paperText(const nlohmann::ordered_json& result);

/// The HTML page of this object with its lists `phantoms` and `figures` (figures.h). Reads the files of the figures
/// from `folder`.
std::string paperPage(nlohmann::ordered_json result, const std::filesystem::path& folder);

}  // namespace hemitex::cli
