/// What pages that carry all they need inside are put together from.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// Puts `by` in the place of the first `mark`, which the text has.
void fillIn(std::string& text, const std::string& mark, const std::string& by);

/// JSON for a script element, which the letters `</` could end.
std::string scriptText(const nlohmann::ordered_json& json);

/// A file's bytes as letters, for a picture inside a page.
std::string base64OfFile(const std::filesystem::path& file);

}  // namespace hemitex::cli
