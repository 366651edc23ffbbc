/// HTML pages that need no network: one file with its plots (Chart.js), its numbers and its pictures inside.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// The page with the text `page`, in which these marks appear once each and are replaced: `{{page style}}` and
/// `{{page script}}` by what all pages share, `{{chart library}}` by Chart.js, `{{result}}` by what the page shows.
std::string completePage(std::string page, const nlohmann::ordered_json& result);

/// A file's bytes as letters, for a picture inside a page.
std::string base64OfFile(const std::filesystem::path& file);

}  // namespace hemitex::cli
