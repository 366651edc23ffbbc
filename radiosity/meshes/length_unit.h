/// The unit of lengths that exporters state in comments at the start of an OBJ file, such as "File units = meters"
/// (SketchUp), "This file uses centimeters as units for non-parametric coordinates." (Maya) or "units: mm".
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hemitex::radiosity {

/// Metres per unit of length, by the comments before the first vertex that have the word `unit` and a name of a length.
/// Nothing if none has. Where they have several lengths or numbers other than 1, that is nothing, too, with a warning.
std::optional<double> statedMetresPerUnit(std::string_view text, std::vector<std::string>& warnings);
/// The same of a file; nothing if it cannot be read. Comments beyond its first 64 KiB do not count.
std::optional<double> statedMetresPerUnit(const std::filesystem::path& file, std::vector<std::string>& warnings);

}  // namespace hemitex::radiosity
