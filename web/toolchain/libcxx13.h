/// What libc++ 13 lacks of C++20, as far as hemitex uses it. Emscripten 3.1.6 has that library; the compiler includes
/// this file before each source. Reading and writing numbers gives the same results as libstdc++.
#pragma once

#include <strings.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <type_traits>

namespace std {

/// Copies the bits of a value into another type of the same size.
template <typename To, typename From>
constexpr To bit_cast(const From& from) noexcept {
  return __builtin_bit_cast(To, from);
}

/// Reads a decimal number as [charconv.from.chars] says: without leading spaces or plus sign, and not in hexadecimal.
inline from_chars_result from_chars(const char* first, const char* last, double& value) {
  const char* digits = first;
  if (digits != last && *digits == '-') ++digits;
  const auto isName = [&](const char* name) {
    return static_cast<size_t>(last - digits) >= strlen(name) && strncasecmp(digits, name, strlen(name)) == 0;
  };
  const bool isNumber =
      digits != last && (isdigit(*digits) || (*digits == '.' && digits + 1 != last && isdigit(digits[1])));
  if (!isNumber && !isName("inf") && !isName("nan")) return {first, errc::invalid_argument};
  const string text(
      first, digits != last && *digits == '0' && digits + 1 != last && (digits[1] | 32) == 'x' ? digits + 1 : last);
  char* end = nullptr;
  errno = 0;
  const double read = strtod(text.c_str(), &end);
  const char* const after = first + (end - text.c_str());
  if (errno == ERANGE && (read == 0 || isinf(read))) return {after, errc::result_out_of_range};
  value = read;
  return {after, errc()};
}

/// Writes the fewest digits that read back to the same bits, in the shorter of the two notations of
/// [charconv.to.chars]; the fixed one where both are as long.
template <typename Number>
requires is_floating_point_v<Number> to_chars_result to_chars(char* first, char* last, Number value) {
  char scientific[32], fixed[512];
  for (int digits = 0; digits < 17; ++digits) {
    snprintf(scientific, sizeof scientific, "%.*e", digits, value);
    if ((is_same_v<Number, float> ? strtof(scientific, nullptr) : strtod(scientific, nullptr)) == value) break;
  }
  const char* const exponent = strchr(scientific, 'e');
  string text = scientific;
  if (exponent) {
    const int mantissaDigits = static_cast<int>(strcspn(scientific + (value < 0), "e")) - 1;
    const int decimals = max(0, max(0, mantissaDigits - 1) - atoi(exponent + 1));
    snprintf(fixed, sizeof fixed, "%.*f", decimals, value);
    if (strlen(fixed) <= text.size()) text = fixed;
  }
  if (text.size() > static_cast<size_t>(last - first)) return {last, errc::value_too_large};
  return {copy(text.begin(), text.end(), first), errc()};
}

}  // namespace std
