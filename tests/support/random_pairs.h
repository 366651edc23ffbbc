/// Pairs of random vectors test a renderer without another one: their item buffers are equal, whatever they show.
#pragma once

#include <array>
#include <cstdint>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::tests {

using reference::TestVector;

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

}  // namespace hemitex::tests
