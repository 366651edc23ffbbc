/// Conversion between numbers and text, independent of the locale. Files get the shortest decimals that read back to
/// the same bits; people get four significant digits.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "raster/base/short_number.h"

namespace hemitex::cli {

using raster::parseInteger;
using raster::parseNumber;
using raster::toText;

/// Reads `x,y,z`, exactly three finite numbers; nothing for any other text.
std::optional<glm::dvec3> parseVector(std::string_view text);

/// A number with four significant digits, for people.
std::string roundedText(double value);
/// A share of 1 in percent with four significant digits, for people.
std::string percentText(double share);

}  // namespace hemitex::cli
