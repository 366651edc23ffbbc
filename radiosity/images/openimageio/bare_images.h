/// Image files without what their readers may fail at. OpenImageIO 2.4 reads beyond the text that cameras put into JPEG
/// files, and libpng and OpenEXR take the memory that a part of a file promises, up to 2 GiB, before they read it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace hemitex::radiosity {

/// A PNG or JPEG file with nothing but what its pixels need: no texts, dates, profiles and previews. What follows a
/// part that is cut off is left out.
std::vector<unsigned char> barePng(std::string_view bytes);
std::vector<unsigned char> bareJpeg(std::string_view bytes);

/// Whether an EXR file is at least as long as the attributes in its headers.
bool holdsItsAttributes(const std::string& exr);

}  // namespace hemitex::radiosity
