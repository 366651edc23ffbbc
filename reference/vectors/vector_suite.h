/// The vector suite: small test vectors, made by this program, each aimed at faults that rasterizers and blend units
/// have. Together they pin the raster rules: whoever answers all of them word for word has a backend; and one hash
/// over their words says whether a compiler, a level of optimization or a machine changed any answer.
///
/// The scenes' vectors (scene_vectors.h) are the other part of the suite; what is here needs the rasterizer alone.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "reference/vectors/vector_file.h"

namespace hemitex::reference {

/// All vectors that are made by hand, in a fixed order, names unique. Every one has a line in `catches`.
std::vector<TestVector> vectorSuite();

/// The item buffers of a vector's faces, by the reference renderer.
std::vector<raster::ItemBuffer> render(const TestVector& vector);

/// wordsHash over the words of all faces, in their order.
std::string wordsHash(std::span<const raster::ItemBuffer> buffers);

/// What a run over a suite says: a line `hash name` a vector, in order, and a last line `hash suite` over the words of
/// all.
std::string suiteHashes(std::span<const TestVector> suite);

}  // namespace hemitex::reference
