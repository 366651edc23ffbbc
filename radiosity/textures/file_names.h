/// Names of surfaces as names of files.
#pragma once

#include <string>
#include <vector>

namespace hemitex::radiosity {

/// One file name (without its ending) a name: letters, digits, `.`, `_` and `-` are kept, anything else becomes `_`.
/// No two are equal, upper and lower case taken as equal, and none is in `reserved` (lower case); a name that is
/// taken gets `-2`, `-3`, ... behind it. At most 100 characters of a name are kept.
std::vector<std::string> uniqueFileNames(const std::vector<std::string>& names,
                                         const std::vector<std::string>& reserved = {});

}  // namespace hemitex::radiosity
