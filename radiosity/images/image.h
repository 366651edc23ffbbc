/// Image files: reads material maps, writes pictures and radiosity textures. The sRGB curve uses only + - * / and sqrt,
/// so that all machines give the same pixels.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <vector>

namespace hemitex::radiosity {

/// What an image shows outside [0,1]^2, along an axis: the image again, the colour of its edge, or its mirror image.
enum class Wrap { Repeat, Clamp, Mirror };

/// How texture coordinates lead to a place in an image.
struct Sampler {
  /// The columns of the matrix from (u, v, 1). A list of images with a matrix of GLM would copy instead of move them
  /// when it grows, and take twice the memory.
  std::array<double, 6> place = {1, 0, 0, 1, 0, 0};
  std::array<Wrap, 2> wrap = {Wrap::Repeat, Wrap::Repeat};

  glm::dvec2 operator()(const glm::dvec2& texcoord) const {
    return {place[0] * texcoord.x + place[2] * texcoord.y + place[4],
            place[1] * texcoord.x + place[3] * texcoord.y + place[5]};
  }
  bool operator==(const Sampler&) const = default;
};

/// Row-major RGB image with linear values; row 0 is the top.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<glm::dvec3> pixels;  ///< width * height pixels
  Sampler sampler = {};
  std::vector<float> alpha = {};  ///< of each pixel; empty if all are 1
};

/// Row-major RGB image with 8-bit sRGB codes, in an eighth of the memory of an Image; row 0 is the top.
struct CodedImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> codes;  ///< 3 * width * height codes
  Sampler sampler = {};
  std::vector<bool> isHole = {};  ///< pixels with alpha 0; empty if all have 1
};

/// Image with any number of named channels, such as one per band of wavelengths: row-major, linear values, channel by
/// channel within a pixel; row 0 is the top.
struct ChannelImage {
  int width = 0;
  int height = 0;
  std::vector<std::string> channels;  ///< their names; at least one
  std::vector<double> values;         ///< width * height * channels
};

/// The linear value in [0,1] of an sRGB-encoded value in [0,1] (IEC 61966-2-1).
double decodeSrgb(double encoded);
/// As above per band; values outside [0,1] are clamped.
glm::dvec3 decodeSrgb(const glm::dvec3& encoded);
/// The 8-bit sRGB code nearest to a linear value. Values outside [0,1] are clamped; NaN gives 0.
std::uint8_t encodeSrgb(double linear);
CodedImage encodeSrgb(const Image& image);
Image decodeSrgb(const CodedImage& image);

/// The pixel that an image shows at a cell of its endless grid; columns count from u = 0, rows from v = 0, the bottom.
std::size_t wrappedPixel(int width, int height, const std::array<Wrap, 2>& wrap, std::int64_t column, std::int64_t row);
/// A place in an image, moved by whole periods to [0, 2), or clamped to [0, 1]; no digits are lost far from zero.
glm::dvec2 nearPlace(const glm::dvec2& place, const std::array<Wrap, 2>& wrap);

/// The colour at texture coordinates, bilinear in linear values between pixel centres; v = 0 is the bottom. Both give
/// the same colour for an image and its codes if the image has only values of codes.
glm::dvec3 bilinear(const Image& image, const glm::dvec2& uv);
glm::dvec3 bilinear(const CodedImage& image, const glm::dvec2& uv);

/// Reads an image as linear RGB with alpha. 8-bit files are sRGB-decoded, others are linear. Grey becomes three equal
/// channels. An image of more than 2^24 pixels is reduced while it is read: its sides are divided by the
/// smallest power of two that gives at most 2^24 pixels, and each new pixel is the mean of the linear values that it
/// covers. Throws InputError if the file cannot be read, contains a NaN or an infinity, or has more than 2^28 pixels.
Image readImage(const std::filesystem::path& file);

/// As readImage for the bytes of a PNG, JPEG or WebP file; `name` is for messages.
Image decodeImage(const std::vector<unsigned char>& bytes, const std::filesystem::path& name);

/// The bytes of an 8-bit sRGB PNG, with alpha if it has holes; equal pixels give equal bytes. Throws InputError, which
/// names `file`, if the image cannot be encoded.
std::vector<unsigned char> encodePng(const CodedImage& image, const std::filesystem::path& file);
/// Writes an 8-bit sRGB PNG; equal pixels give equal files. Throws InputError if the file cannot be written.
void writePng(const std::filesystem::path& file, const Image& image);
/// Writes a 32-bit float linear RGB EXR; equal pixels give equal files. Throws InputError as writePng, and if a value
/// exceeds the range of 32-bit floats.
void writeExr(const std::filesystem::path& file, const Image& image);
void writeExr(const std::filesystem::path& file, const ChannelImage& image);

}  // namespace hemitex::radiosity
