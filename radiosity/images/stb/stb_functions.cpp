/// Image functions of programs without the module hemitex_images. They only encode PNG, by stb_image_write.
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STB_IMAGE_WRITE_STATIC
#define STBI_WRITE_NO_STDIO
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-function"
#include <stb/stb_image_write.h>
#pragma GCC diagnostic pop

#include "radiosity/images/image_module.h"

namespace hemitex::radiosity {
namespace {

ImageProblem read(const std::string&, std::uint64_t, const RowReceiver&) {
  return {"cannot be read: this program reads no images", ""};
}

ImageProblem decode(const std::vector<unsigned char>&, std::uint64_t, const RowReceiver&) {
  return {"cannot be decoded: this program reads no images", ""};
}

/// Receives the bytes of the encoder.
void append(void* bytes, void* data, int size) {
  const auto* const first = static_cast<const unsigned char*>(data);
  auto& target = *static_cast<std::vector<unsigned char>*>(bytes);
  target.insert(target.end(), first, first + size);
}

ImageProblem encodePng(const ImageSamples& samples, std::vector<unsigned char>& bytes) {
  const int stride = samples.width * samples.channels;
  if (stbi_write_png_to_func(append, &bytes, samples.width, samples.height, samples.channels, samples.codes.data(),
                             stride) == 0)
    return {"cannot be encoded: out of memory", "use smaller faces"};
  return {};
}

ImageProblem encodeExr(const ImageSamples&, std::vector<unsigned char>&) {
  return {"cannot be encoded: this program writes only 8-bit PNG", ""};
}

}  // namespace

const ImageFunctions& imageFunctions() {
  static const ImageFunctions functions = {read, decode};
  return functions;
}

const ImageEncoders& imageEncoders() {
  static const ImageEncoders encoders = {encodePng, encodeExr};
  return encoders;
}

}  // namespace hemitex::radiosity
