/// What pages that carry all they need inside are put together from.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// The page whose text is `page`, with what stands for its parts replaced by them: `{{page style}}` and `{{page
/// script}}` by what pages share, `{{chart library}}` by what draws their plots, and `{{result}}` and `{{pictures}}` by
/// what the page shows. The text has each of them once.
std::string completePage(std::string page, const nlohmann::ordered_json& result,
                         const nlohmann::ordered_json& pictures);

/// A file's bytes as letters, for a picture inside a page.
std::string base64OfFile(const std::filesystem::path& file);

}  // namespace hemitex::cli
