#include "cli/common/numbers.h"

namespace hemitex::cli {

std::optional<glm::dvec3> parseVector(std::string_view text) {
  glm::dvec3 vector{0.0};
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (axis == 2)) return std::nullopt;
    const std::optional<double> value = parseNumber(text.substr(0, comma));
    if (!value) return std::nullopt;
    vector[axis] = *value;
    if (axis < 2) text.remove_prefix(comma + 1);
  }
  return vector;
}

std::string roundedText(double value) { return toText(parseNumber(raster::withDigits(value, 4)).value_or(value)); }

std::string percentText(double share) { return roundedText(100 * share) + " %"; }

}  // namespace hemitex::cli
