#include "cli/report/html_page.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <string_view>

#include "cli/common/json.h"
#include "cli/report/embedded_files.h"
#include "raster/base/file_io.h"

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

std::string base64(const std::string& bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

std::string base64OfFile(const std::filesystem::path& file) { return base64(raster::readFile(file)); }

}  // namespace hemitex::cli
