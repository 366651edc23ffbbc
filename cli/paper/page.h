/// The page of `hemitex paper`: one HTML file with its plots (Chart.js), its numbers and its pictures inside, so that
/// it opens anywhere without a network. The page itself is paper_page.html.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// `result` is the object of paper.json, with the lists `runs`, `speed_ups`, `growth`, `promises`, `phantoms` and
/// `figures`; the files of its figures lie in `folder`.
std::string paperPage(const nlohmann::ordered_json& result, const std::filesystem::path& folder);

}  // namespace hemitex::cli
