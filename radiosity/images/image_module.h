/// The modules for images. hemitex_images reads them, and is the only code that links OpenImageIO: programs open it
/// when they read their first image, because the libraries behind OpenImageIO take longer to load than most commands
/// take to run. hemitex_image_encoders writes them, by libpng and OpenEXR.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace hemitex::radiosity {

/// Samples as a file holds them, row-major, channel by channel: `codes` or `values`.
struct ImageSamples {
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint8_t> codes = {};        ///< of files with 8 bits per channel, else empty
  std::vector<float> values = {};              ///< of all other files, else empty
  std::vector<std::string> channelNames = {};  ///< of `values` to encode
};

/// Receives the rows of an image from the top, some at a time, and none at the first call; `height` is that of the
/// whole image. There are 1 or 3 channels, and then alpha if the file has it; further ones are left out.
using RowReceiver = std::function<void(const ImageSamples& rows, int height)>;

/// Why an image was not read or encoded, and what to do about it; both are empty when it was.
struct ImageProblem {
  std::string problem;
  std::string advice;
};

/// What the module exports under the name `hemitexImageFunctions`. The functions throw nothing but std::bad_alloc and
/// what `receive` throws.
struct ImageFunctions {
  /// Reads a file of at most `maxPixels` pixels, except PNG and JPEG files.
  ImageProblem (*read)(const std::string& file, std::uint64_t maxPixels, const RowReceiver& receive);
  /// Decodes the bytes of a PNG, JPEG or WebP file of at most `maxPixels` pixels.
  ImageProblem (*decode)(const std::vector<unsigned char>& bytes, std::uint64_t maxPixels, const RowReceiver& receive);
};

/// Encodes in memory, so that a full disk is detected when the bytes are written, whatever the encoder does. Equal
/// samples give equal bytes. Throws nothing but std::bad_alloc.
using Encoder = ImageProblem (*)(const ImageSamples& samples, std::vector<unsigned char>& bytes);

/// What the module exports under the name `hemitexImageEncoders`.
struct ImageEncoders {
  Encoder png;  ///< of `codes` in 3 channels, or in 4 with alpha
  Encoder exr;  ///< of `values` in any number of named channels, with 32 bits each
};

/// Opens the module that reads at the first call. Throws std::runtime_error where it is not found, and InputError if a
/// limit of the address space leaves too little for its libraries.
const ImageFunctions& imageFunctions();
/// Opens the module that writes at the first call. Throws std::runtime_error where it is not found.
const ImageEncoders& imageEncoders();

}  // namespace hemitex::radiosity
