/// Text of users in XML and HTML.
#pragma once

#include <string>
#include <string_view>

#include "raster/base/printable_text.h"

namespace hemitex::reference {

/// Printable text (raster/base/printable_text.h) with the characters of markup escaped; line ends stay with
/// `keepsLines`.
inline std::string markupText(std::string_view text, bool keepsLines = false) {
  std::string result;
  for (const char c : raster::printable(text, keepsLines ? "\n" : ""))
    result += c == '&' ? "&amp;" : c == '<' ? "&lt;" : c == '>' ? "&gt;" : c == '"' ? "&quot;" : std::string(1, c);
  return result;
}

}  // namespace hemitex::reference
