#include "raster/base/printable_text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <utility>

namespace hemitex::raster {
namespace {

/// A character of UTF-8; `size` is 1 and `code` is `invalid` for a byte that begins none.
struct Character {
  std::uint32_t code;
  std::size_t size;
};
constexpr std::uint32_t invalid = 0xFFFFFFFF;

/// The first character of a text that is not empty (RFC 3629).
Character firstCharacter(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const auto size = static_cast<std::size_t>(std::countl_one(byte(0)));
  if (size == 0) return {byte(0), 1};
  if (size == 1 || size > 4 || size > text.size()) return {invalid, 1};
  std::uint32_t code = byte(0) & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return {invalid, 1};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> smallest{0, 0, 0x80, 0x800, 0x10000};
  const bool isSurrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < smallest[size] || code > 0x10FFFF || isSurrogate) return {invalid, 1};
  return {code, size};
}

bool isControl(std::uint32_t code) {
  constexpr std::array<std::pair<std::uint32_t, std::uint32_t>, 7> ranges{{{0, 0x1F},
                                                                           {0x7F, 0x9F},
                                                                           {0x61C, 0x61C},
                                                                           {0x200E, 0x200F},
                                                                           {0x2028, 0x202E},
                                                                           {0x2066, 0x2069},
                                                                           {invalid, invalid}}};
  return std::any_of(ranges.begin(), ranges.end(),
                     [code](const auto& range) { return code >= range.first && code <= range.second; });
}

/// The text with `replace(code)` for the characters that isControl() names, but those that are in `kept`.
template <typename Replace>
std::string replaced(std::string_view text, std::string_view kept, const Replace& replace) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const auto special = std::find_if(text.begin(), text.end(), [](char c) { return c < 0x20 || c > 0x7E; });
    result.append(text.begin(), special);
    text.remove_prefix(static_cast<std::size_t>(special - text.begin()));
    if (text.empty()) break;
    const auto [code, size] = firstCharacter(text);
    const bool stays = !isControl(code) || (size == 1 && kept.find(text.front()) != std::string_view::npos);
    if (stays)
      result += text.substr(0, size);
    else
      result += replace(code);
    text.remove_prefix(size);
  }
  return result;
}

std::string jsonEscape(std::uint32_t code) {
  std::string text = "\\u0000";
  for (std::size_t digit = 5; digit > 1; --digit, code >>= 4) text[digit] = "0123456789abcdef"[code & 0xF];
  return text;
}

}  // namespace

std::string printable(std::string_view text, std::string_view kept) {
  return replaced(text, kept, [](std::uint32_t) { return std::string("?"); });
}

std::string printableJson(std::string_view json) { return replaced(json, "\n", jsonEscape); }

}  // namespace hemitex::raster
