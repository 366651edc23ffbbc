/// The files that `hemitex solve` reads and writes, to find out before the work whether one would replace another.
#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "cli/solve/edits_file.h"
#include "cli/solve/options.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

/// The names of all files of a result, relative to its folder. Those of a frame are as if its edits added no surface.
std::set<std::string> outputNames(const SolveOptions& options, const radiosity::Scene& scene,
                                  const radiosity::Discretization& discretization, std::size_t frames);

/// All files that were read: the scene with its materials and images, the camera, the lights, the edits and what they
/// add.
std::set<std::filesystem::path> inputFiles(const SolveOptions& options, const radiosity::Scene& scene,
                                           const std::vector<Frame>& frames);

}  // namespace hemitex::cli
