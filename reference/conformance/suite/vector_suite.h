/// The vector suite: small generated test vectors, each aimed at faults of rasterizers and blend units. Together they
/// specify the raster rules: a backend that draws all of them with equal item IDs is correct. One hash over their item
/// IDs shows whether a compiler, an optimization level or a machine changes any of them.
///
/// The vectors of scenes (scene_vectors.h) are the other part of the suite. The vectors here need only the rasterizer.
#pragma once

#include <array>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// All vectors but those of scenes, in a fixed order, with unique names. Each has a line in `catches`.
std::vector<TestVector> vectorSuite();

/// The vectors of each theme, one source file per theme.
std::vector<TestVector> meshVectors();      ///< triangles that share edges: every sample once
std::vector<TestVector> coverageVectors();  ///< snapping, needles, clipping: which samples a triangle covers
std::vector<TestVector> depthVectors();     ///< which of several triangles is visible at a sample
std::vector<TestVector> texelVectors();     ///< which texel a sample shows
std::vector<TestVector> idVectors();        ///< the item ID of an offset and a texel
std::vector<TestVector> viewVectors();      ///< faces, viewports, scissor rectangles

/// The suite of version 2 of the rules, which vectorSuite does not hold: at most 8 x 8 pixels each.
std::vector<TestVector> drawVectors();

/// The binary32 numbers next below k/N, nearest to it and next above it, for all k from 0 to N: each fills a pixel, the
/// texel's number its item ID. Along u first, then along v with a mark of 0x10000.
TestVector texelBorders(int texels);

struct SuiteTheme {
  const char* name;
  std::vector<TestVector> (*vectors)();
};

/// In the order of the suite.
inline constexpr std::array<SuiteTheme, 6> suiteThemes{{{"meshes", meshVectors},
                                                        {"coverage", coverageVectors},
                                                        {"depth", depthVectors},
                                                        {"texels", texelVectors},
                                                        {"ids", idVectors},
                                                        {"views", viewVectors}}};

}  // namespace hemitex::reference
