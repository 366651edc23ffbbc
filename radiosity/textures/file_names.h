/// Converts names of surfaces to file names.
#pragma once

#include <string>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// One file name (without extension) per name. Letters, digits, `.`, `_` and `-` are kept; other characters become `_`.
/// All are different, ignoring case, and none is in `reserved` (lower case); duplicates get the suffix `-2`, `-3`, ...
/// Names are cut to 100 characters.
std::vector<std::string> uniqueFileNames(const std::vector<std::string>& names,
                                         const std::vector<std::string>& reserved = {});

/// The names of a scene's surfaces as objects of files, one per surface, by the same rules.
std::vector<std::string> objectNames(const Scene& scene);

}  // namespace hemitex::radiosity
