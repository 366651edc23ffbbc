/// Random numbers that are equal on every machine.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>

namespace hemitex::reference {

/// The standard defines the values of std::mt19937_64, but not those of its distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// 32 random bits.
  std::uint32_t bits() { return static_cast<std::uint32_t>(engine_() >> 32); }
  /// A whole number in [0, count).
  std::uint32_t below(std::uint32_t count) {
    return static_cast<std::uint32_t>(std::uint64_t{bits()} * std::uint64_t{count} >> 32);
  }
  /// A whole number in [low, high].
  int between(int low, int high) { return low + static_cast<int>(below(static_cast<std::uint32_t>(high - low) + 1)); }
  /// True once in `count` times.
  bool isOneIn(std::uint32_t count) { return below(count) == 0; }
  /// A number in [low, high): 24 random bits times the width of the interval.
  float uniform(float low, float high) { return low + (high - low) * (static_cast<float>(bits() >> 8) * 0x1p-24f); }
  template <typename T>
  T oneOf(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<std::uint32_t>(values.size()))];
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace hemitex::reference
