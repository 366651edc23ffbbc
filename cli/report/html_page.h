/// Makes HTML pages that need no network: one file contains script, plot library, numbers and pictures.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// A complete page. `page` holds title, style, content and script; `result` is the object that the script shows. Adds
/// page_style.css, page_script.js and Chart.js, which all pages share.
std::string completePage(const std::string& page, const nlohmann::ordered_json& result);

/// Bytes in base64.
std::string base64(const std::string& bytes);
/// The bytes of a file in base64, for a picture inside a page. Throws InputError if the file cannot be read.
std::string base64OfFile(const std::filesystem::path& file);

}  // namespace hemitex::cli
