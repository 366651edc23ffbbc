/// Numbers as text, independent of the locale of C and of C++.
#pragma once

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

}  // namespace hemitex::raster
