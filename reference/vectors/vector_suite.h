/// The vector suite: small test vectors, made by this program, each aimed at faults that rasterizers and blend units
/// have. Together they pin the raster rules: whoever answers all of them item ID for item ID has a backend; and one
/// hash over their item IDs says whether a compiler, a level of optimization or a machine changed any answer.
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

/// idsHash over the item IDs of all faces, in their order.
std::string idsHash(std::span<const raster::ItemBuffer> buffers);

/// What a run over a suite says: a line `hash name` a vector, in order, and a last line `hash suite` over the item IDs
/// of all.
std::string suiteHashes(std::span<const TestVector> suite);

/// The vectors of each theme, a source file each.
std::vector<TestVector> meshVectors();      ///< triangles that share edges: every sample once
std::vector<TestVector> coverageVectors();  ///< snapping, needles, clipping: which samples a triangle covers
std::vector<TestVector> depthVectors();     ///< which of several triangles wins a sample
std::vector<TestVector> texelVectors();     ///< which texel a sample shows
std::vector<TestVector> idVectors();        ///< what item ID comes of offset and texel
std::vector<TestVector> viewVectors();      ///< faces, viewports, scissor rectangles

/// A vector whose only face is called front, or whose faces are numbered.
TestVector makeVector(std::string name, std::string catches, raster::DrawList list, std::vector<raster::Face> faces);

}  // namespace hemitex::reference
