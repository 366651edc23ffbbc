/// Random test vectors: a seed and a family (random_families.h) give the same vector on every machine. Authors of
/// backends check as many as they like, beyond the fixed ones of the suite.
///
/// Pairs of vectors test a renderer without another one: their item buffers are equal, whatever they show.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// The vector of a seed, with the name FAMILY-SEED. Throws InputError with all names for an unknown family.
TestVector randomVector(std::uint64_t seed, const std::string& family);

/// Vector `index` of an endless sequence through all families: one vector of each with `seed`, then with `seed` + 1,
/// and so on.
TestVector interleavedRandomVector(std::uint64_t seed, std::uint64_t index);

/// How the second vector of a pair comes from the first.
enum class Relation {
  TranslatedEye,  ///< eye and positions move by the same vector, exactly
  SplitTriangle,  ///< the middle of an edge divides a triangle into two
  PermutedDraws,  ///< draws change their order; no two draws share a depth
  SplitDraw,      ///< a draw becomes two with the same state
};

constexpr std::array<Relation, 4> allRelations{Relation::TranslatedEye, Relation::SplitTriangle,
                                               Relation::PermutedDraws, Relation::SplitDraw};

struct VectorPair {
  TestVector first, second;
};

/// Two different vectors of one face each whose item buffers are equal by the rules.
VectorPair randomPair(std::uint64_t seed, Relation relation);

}  // namespace hemitex::reference
