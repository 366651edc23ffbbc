#include "tests/accuracy/numbers.h"

#include <cmath>
#include <cstdio>

namespace hemitex::accuracy {

std::string numberText(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", number);
  std::string result = text;
  // printf writes 1e+30 and 1e-06.
  if (const std::size_t e = result.find('e'); e != std::string::npos)
    result = result.substr(0, e) + "e" + std::to_string(std::stoi(result.substr(e + 1)));
  return result;
}

std::string errorText(double error) {
  if (error == 0) return "0";
  if (error < 1e-10) return "< 1e-10";
  const double unit = std::pow(10, std::floor(std::log10(error)));
  return numberText(std::ceil(error / unit - 1e-9) * unit);
}

}  // namespace hemitex::accuracy
