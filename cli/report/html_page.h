/// Makes HTML pages that need no network: one file contains script, plot library, numbers and pictures.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace hemitex::cli {

/// A complete page. `page` holds title, style, content and script; `result` is the object that the script shows. Adds
/// page_style.css, page_script.js and Chart.js, which all pages share.
std::string completePage(const std::string& page, const nlohmann::ordered_json& result);

}  // namespace hemitex::cli
