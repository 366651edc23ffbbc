/// Numbers as text. They are written as the shortest decimals that read back to the same bits, and read
/// strictly: the whole text, finite, without a locale.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace hemitex::cli {

/// The finite number that `text` is, all of it; nothing for anything else (`nan`, `1e999`, `3 `, `0x1`).
std::optional<double> parseNumber(std::string_view text);
/// The same for a whole number that an int holds.
std::optional<int> parseInteger(std::string_view text);
/// `x,y,z`: exactly three finite numbers.
std::optional<glm::dvec3> parseVector(std::string_view text);

/// The shortest decimal that reads back to the same number.
std::string toText(double value);
std::string toText(float value);

/// A number for people: four significant digits.
std::string roundedText(double value);
/// A share of 1 for people: four significant digits, in percent.
std::string percentText(double share);

}  // namespace hemitex::cli
