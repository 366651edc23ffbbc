#include "raster/base/short_number.h"

#include <array>
#include <charconv>
#include <iomanip>
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

std::string shortNumber(double value) {
  std::ostringstream text;
  text << std::setprecision(3) << value;
  return text.str();
}

std::string toText(double value) { return shortest(value); }
std::string toText(float value) { return shortest(value); }

}  // namespace hemitex::raster
