/// The themes of the vector suite, a source file each.
#pragma once

#include <string>
#include <vector>

#include "reference/vectors/vector_file.h"

namespace hemitex::reference {

std::vector<TestVector> meshVectors();      ///< triangles that share edges: every sample once
std::vector<TestVector> coverageVectors();  ///< snapping, needles, clipping: which samples a triangle covers
std::vector<TestVector> depthVectors();     ///< which of several triangles wins a sample
std::vector<TestVector> texelVectors();     ///< which texel a sample shows
std::vector<TestVector> wordVectors();      ///< what word comes of offset and texel
std::vector<TestVector> viewVectors();      ///< faces, viewports, scissor rectangles

/// A vector whose only face is called front, or whose faces are numbered.
TestVector makeVector(std::string name, std::string catches, raster::DrawList list, std::vector<raster::Face> faces);

}  // namespace hemitex::reference
