/// A hash that recognizes damaged or different text: FNV-1a with 64 bits (Fowler, Noll and Vo).
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>

namespace hemitex::cli {

inline std::uint64_t hashOf(std::string_view bytes, std::uint64_t hash = 14695981039346656037U) {
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211U;
  return hash;
}

/// Number of characters of hashText.
inline constexpr std::size_t hashDigits = 16;

/// A hash in hexadecimal digits.
inline std::string hashText(std::uint64_t hash) {
  std::string text(hashDigits + 1, '\0');
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  text.pop_back();
  return text;
}
inline std::string hashText(std::string_view bytes) { return hashText(hashOf(bytes)); }

}  // namespace hemitex::cli
