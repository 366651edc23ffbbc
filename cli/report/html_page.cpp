#include "cli/report/html_page.h"

#include "cli/common/json.h"
#include "cli/report/embedded_files.h"

namespace hemitex::cli {
namespace {

/// JSON for a script element, with `<` escaped, which could end the element.
std::string scriptText(const nlohmann::ordered_json& json) {
  std::string text = toText(json);
  for (std::size_t at = 0; (at = text.find('<', at)) != std::string::npos;) text.replace(at, 1, "\\u003c");
  return text;
}

}  // namespace

std::string completePage(const std::string& page, const nlohmann::ordered_json& result) {
  return std::string("<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n") +
         "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<style>\n" + pageStyle +
         "</style>\n<script>\n" + pageScript + "</script>\n<script>" + chartLibrary +
         "</script>\n<script type=\"application/json\" id=\"result\">" + scriptText(result) + "</script>\n" + page;
}

}  // namespace hemitex::cli
