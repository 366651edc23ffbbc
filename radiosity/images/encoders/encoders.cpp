/// The module hemitex_image_encoders: image files by libpng and OpenEXR.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <png.h>

#include <algorithm>
#include <exception>
#include <new>
#include <string>
#include <utility>

#include "radiosity/images/image_module.h"

namespace hemitex::radiosity {
namespace {

ImageProblem notEncoded(const std::string& cause) { return {"cannot be encoded: " + cause, "use a smaller image"}; }

/// Where OpenEXR writes a file.
class ByteStream : public Imf::OStream {
 public:
  ByteStream() : OStream("memory") {}

  void write(const char* text, int count) override {
    const auto size = static_cast<std::size_t>(count);
    bytes.resize(std::max(bytes.size(), place_ + size));
    std::copy_n(text, size, bytes.begin() + static_cast<std::ptrdiff_t>(place_));
    place_ += size;
  }
  std::uint64_t tellp() override { return place_; }
  void seekp(std::uint64_t place) override { place_ = place; }

  std::vector<unsigned char> bytes;

 private:
  std::size_t place_ = 0;
};

ImageProblem encodePng(const ImageSamples& samples, std::vector<unsigned char>& bytes) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(samples.width);
  image.height = static_cast<png_uint_32>(samples.height);
  image.format = samples.channels == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  bytes.resize(PNG_IMAGE_PNG_SIZE_MAX(image));
  png_alloc_size_t size = bytes.size();
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, samples.codes.data(), 0, nullptr) == 0)
    return notEncoded(image.message);
  bytes.resize(size);
  bytes.shrink_to_fit();
  return {};
}

ImageProblem encodeExr(const ImageSamples& samples, std::vector<unsigned char>& bytes) try {
  Imf::Header header(samples.width, samples.height);
  Imf::FrameBuffer pixels;
  const std::size_t stride = sizeof(float) * static_cast<std::size_t>(samples.channels);
  for (std::size_t c = 0; c < samples.channelNames.size(); ++c) {
    // OpenEXR has one type for the samples that it reads and writes.
    char* const first = reinterpret_cast<char*>(const_cast<float*>(samples.values.data() + c));
    header.channels().insert(samples.channelNames[c], Imf::Channel(Imf::FLOAT));
    pixels.insert(samples.channelNames[c],
                  Imf::Slice(Imf::FLOAT, first, stride, stride * static_cast<std::size_t>(samples.width)));
  }
  ByteStream stream;
  {
    Imf::OutputFile output(stream, header, 0);
    output.setFrameBuffer(pixels);
    output.writePixels(samples.height);
  }
  bytes = std::move(stream.bytes);
  return {};
} catch (const std::bad_alloc&) {
  throw;
} catch (const std::exception& error) {
  return notEncoded(error.what());
}

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default"))) const hemitex::radiosity::ImageEncoders hemitexImageEncoders = {
    hemitex::radiosity::encodePng, hemitex::radiosity::encodeExr};
