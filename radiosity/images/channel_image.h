/// Images with any number of named channels, such as one per band of wavelengths.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hemitex::radiosity {

/// Row-major, linear values, channel by channel within a pixel; row 0 is the top.
struct ChannelImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< their names; at least one
  std::vector<double> values;         ///< width * height * channels
};

/// Writes a 32-bit float EXR; equal values give equal files. Throws InputError as writeExr of an Image.
void writeExr(const std::filesystem::path& file, const ChannelImage& image);

}  // namespace hemitex::radiosity
