/// Converts names of a scene to names in files.
#pragma once

#include <string>
#include <vector>

namespace hemitex::radiosity {

/// One file name (without extension) per name. Letters, digits, `.`, `_` and `-` are kept; other characters become `_`.
/// All are different, ignoring case, and none is in `reserved` (lower case); duplicates get the suffix `-2`, `-3`, ...
/// Names are cut to 100 characters.
std::vector<std::string> uniqueFileNames(const std::vector<std::string>& names,
                                         const std::vector<std::string>& reserved = {});

/// One name of an OBJ or MTL file per name. Blanks and control characters become `_`, because programs end names there.
/// All are different; duplicates get the suffix `~2`, `~3`, ...
std::vector<std::string> uniqueObjNames(const std::vector<std::string>& names);

}  // namespace hemitex::radiosity
