/// The page of `hemitex paper`, cli/paper/report.html with its numbers and pictures (cli/report/html_page.h).
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// `result` is the object of paper.json, with the lists `runs`, `speed_ups`, `growth`, `phantoms` and `figures`;
/// the files of its figures lie in `folder`.
std::string paperPage(nlohmann::ordered_json result, const std::filesystem::path& folder);

}  // namespace hemitex::cli
