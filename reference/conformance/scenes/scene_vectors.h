/// The part of the vector suite that comes from scenes: hemicubes in the paper's room and in the Cornell box.
#pragma once

#include <filesystem>
#include <vector>

#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::reference {

/// Five faces from three points each of data/cornell-box.obj and data/paper-room.obj; `data` is that folder. Their
/// names begin with "scene-" and ascend. Throws InputError where the scenes cannot be read.
std::vector<TestVector> sceneVectors(const std::filesystem::path& data);

/// The whole suite: vectorSuite(), then sceneVectors(data).
std::vector<TestVector> wholeSuite(const std::filesystem::path& data);

}  // namespace hemitex::reference
