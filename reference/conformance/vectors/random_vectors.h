/// Random test vectors: a seed and a family give the same vector on every machine. Authors of backends check as many as
/// they like, beyond the fixed ones of the suite.
///
/// Each family is aimed at typical faults of rasterizers and blend units: slivers, samples on edges, texel borders on
/// samples, clipping, depth ties, facing, sums that overflow channels, and more. Each vector has at most ten triangles
/// and small faces, so that devices and exact evaluators draw it in about a millisecond.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <random>
#include <string>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// Random numbers that are equal on every machine. The standard defines the values of std::mt19937_64, but not those of
/// its distributions.
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

/// Triangles and the faces that show them.
struct Drawing {
  raster::DrawList list;
  std::vector<raster::Face> faces;
};

struct RandomFamily {
  const char* name;
  const char* catches;  ///< one line: the faults that it detects
  Drawing (*make)(Random&);
};

/// All families of version 1 of the rules, in a fixed order, with unique names.
const std::vector<RandomFamily>& randomFamilies();
/// Those of version 2.
const std::vector<RandomFamily>& newRandomFamilies();

/// The vector of a seed, with the name FAMILY-SEED. Throws InputError with all names for an unknown family.
TestVector randomVector(std::uint64_t seed, const std::string& family);

/// Vector `index` of an endless sequence through all families of version 1: one vector of each with `seed`, then with
/// `seed` + 1, and so on.
TestVector interleavedRandomVector(std::uint64_t seed, std::uint64_t index);

}  // namespace hemitex::reference
