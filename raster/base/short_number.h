/// Numbers as text, independent of the locale of C and of C++.
#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

namespace hemitex::raster {

/// A number with three digits, for messages.
std::string shortNumber(double value);

/// A number with at most `digits` significant digits.
std::string withDigits(double value, int digits);

/// The shortest decimal that reads back to the same number, for files.
std::string toText(double value);
std::string toText(float value);

/// Reads a finite number. The whole text must be the number; nothing for `nan`, `1e999`, `3 `, `+3` or `0x1`.
std::optional<double> parseNumber(std::string_view text);

/// Reads an integer in the range of its type. The whole text must be digits, behind a minus sign if the type has one;
/// nothing for any other text.
template <typename Integer = int>
std::optional<Integer> parseInteger(std::string_view text) {
  Integer value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  return error == std::errc() && rest == end ? std::optional(value) : std::nullopt;
}

}  // namespace hemitex::raster
