#include "raster/base/short_number.h"

#include <array>
#include <cmath>
#include <iomanip>
#include <locale>
#include <sstream>

namespace hemitex::raster {
namespace {

template <typename Number>
std::string shortest(Number value) {
  std::array<char, 32> digits{};
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr;
  return {digits.data(), end};
}

}  // namespace

std::string shortNumber(double value) { return withDigits(value, 3); }

std::string withDigits(double value, int digits) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text << std::setprecision(digits) << value;
  return text.str();
}

std::string toText(double value) { return shortest(value); }
std::string toText(float value) { return shortest(value); }

std::optional<double> parseNumber(std::string_view text) {
  double value = 0;
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, value);
  if (error != std::errc{} || rest != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace hemitex::raster
