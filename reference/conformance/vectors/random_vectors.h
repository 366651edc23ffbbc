/// Random test vectors: a seed and a family give the same vector on every machine. Authors of backends check as many as
/// they like, beyond the fixed ones of the suite.
///
/// Each family is aimed at typical faults of rasterizers and blend units: slivers, samples on edges, texel borders on
/// samples, clipping, depth ties, facing, sums that overflow channels, and more. Each vector has at most ten triangles
/// and small faces, so that devices and exact evaluators draw it in about a millisecond.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/conformance/vectors/random.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

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
