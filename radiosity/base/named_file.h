/// Files that a scene names, as programs on other systems write the names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hemitex::radiosity {

/// The file that `name` in a file of `folder` means; nothing if there is none. Quotes around the name are left out. The
/// first of these counts: the name as it is; with `/` for each backslash; the same in other capital letters; what is
/// left without the first folders of the name, such as those of the author's machine.
std::optional<std::filesystem::path> namedFile(const std::filesystem::path& folder, std::string name);

}  // namespace hemitex::radiosity
