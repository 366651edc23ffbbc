/// Names in small letters, by which files and words are compared. Letters outside ASCII stay, whatever the locale is.
#pragma once

#include <filesystem>
#include <string>

namespace hemitex::raster {

inline std::string lowerCase(std::string text) {
  for (char& letter : text)
    if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
  return text;
}

/// The end of a file's name with its point, such as `.glb`, in small letters.
inline std::string endingOf(const std::filesystem::path& file) { return lowerCase(file.extension().string()); }

}  // namespace hemitex::raster
