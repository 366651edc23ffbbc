#include "cli/common/numbers.h"

#include <array>
#include <charconv>
#include <cmath>

namespace hemitex::cli {
namespace {

template <typename Number>
std::optional<Number> parseAll(std::string_view text) {
  Number value{};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end) return std::nullopt;
  return value;
}

}  // namespace

std::optional<double> parseNumber(std::string_view text) {
  const std::optional<double> value = parseAll<double>(text);
  if (!value || !std::isfinite(*value)) return std::nullopt;
  return value;
}

std::optional<int> parseInteger(std::string_view text) { return parseAll<int>(text); }

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

std::string roundedText(double value) {
  std::array<char, 32> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), value, std::chars_format::general, 4).ptr;
  return toText(parseAll<double>({digits.data(), end}).value_or(value));
}

std::string percentText(double share) { return roundedText(100 * share) + " %"; }

}  // namespace hemitex::cli
