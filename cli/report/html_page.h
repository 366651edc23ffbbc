/// HTML pages that need no network: one file with its plots (Chart.js), its numbers and its pictures inside.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// A page from its title, its own style, its content and its script, behind what all pages share: page_style.css,
/// page_script.js, Chart.js, and `result`, the object that the page shows.
std::string completePage(const std::string& page, const nlohmann::ordered_json& result);

/// A file's bytes as letters, for a picture inside a page.
std::string base64OfFile(const std::filesystem::path& file);

}  // namespace hemitex::cli
