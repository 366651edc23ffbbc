/// Images at the edge of the library: reading material maps, writing pictures and radiosity textures, and the sRGB
/// curve, evaluated with + - * / and sqrt alone so that every machine gives the same pixels.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <vector>

namespace hemitex::radiosity {

/// Row-major RGB; row 0 is the top of a picture. Values are linear.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<glm::dvec3> pixels;  ///< width * height of them
};

/// The linear value in [0,1] of an sRGB-encoded value in [0,1] (IEC 61966-2-1).
double decodeSrgb(double encoded);
/// The 8-bit code nearest to a linear value in sRGB; values outside [0,1] clamp, a NaN gives 0.
std::uint8_t encodeSrgb(double linear);

/// Reads an image as linear RGB: 8-bit files are sRGB-decoded, others taken as linear; grey becomes three equal
/// channels, alpha is dropped. Throws InputError where the file cannot be read, holds a NaN or an infinity, or has more
/// than 2^28 pixels.
Image readImage(const std::filesystem::path& file);

/// Writes an 8-bit sRGB PNG: equal pixels give equal files. Throws InputError where the file cannot be written.
void writePng(const std::filesystem::path& file, const Image& image);
/// Writes a 32-bit float linear RGB EXR: equal pixels give equal files. Throws as writePng, and where a
/// value is above what 32 bits hold.
void writeExr(const std::filesystem::path& file, const Image& image);

}  // namespace hemitex::radiosity
