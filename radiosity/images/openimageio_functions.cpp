/// The module hemitex_images: image files by OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>

#include "radiosity/images/image_module.h"

namespace hemitex::radiosity {
namespace {

/// Alpha is dropped, so colours must not be multiplied by it.
OIIO::ImageSpec unassociatedAlpha() {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  return config;
}

/// Reads the pixels of an image that is open.
ImageProblem readPixels(OIIO::ImageInput* input, std::uint64_t maxPixels, ImageSamples& samples) {
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.image_pixels() > maxPixels) return {"has too many pixels", "scale it down to at most 16384 x 16384"};
  samples = {spec.width, spec.height, spec.nchannels, {}, {}};
  const std::size_t count = spec.image_pixels() * static_cast<std::size_t>(spec.nchannels);
  const bool holdsCodes = spec.format == OIIO::TypeDesc::UINT8;
  holdsCodes ? samples.codes.resize(count) : samples.values.resize(count);
  const bool isRead = holdsCodes
                          ? input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UINT8, samples.codes.data())
                          : input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::FLOAT, samples.values.data());
  if (!isRead || count == 0) return {"cannot be read: " + input->geterror(), ""};
  return {};
}

ImageProblem read(const std::string& file, std::uint64_t maxPixels, ImageSamples& samples) {
  const OIIO::ImageSpec config = unassociatedAlpha();
  const auto input = OIIO::ImageInput::open(file, &config);
  if (!input) return {"cannot be read as an image: " + OIIO::geterror(), ""};
  return readPixels(input.get(), maxPixels, samples);
}

ImageProblem decode(const std::vector<unsigned char>& bytes, std::uint64_t maxPixels, ImageSamples& samples) {
  constexpr std::array<unsigned char, 4> png{0x89, 'P', 'N', 'G'};
  constexpr std::array<unsigned char, 2> jpeg{0xff, 0xd8};
  const auto beginsWith = [&bytes](const auto& start) {
    return bytes.size() > start.size() && std::equal(start.begin(), start.end(), bytes.begin());
  };
  if (!beginsWith(png) && !beginsWith(jpeg)) return {"is neither PNG nor JPEG", "export it as PNG"};
  const std::string format = beginsWith(png) ? "png" : "jpeg";
  OIIO::Filesystem::IOMemReader memory(const_cast<unsigned char*>(bytes.data()), bytes.size());
  const auto input = OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec;
  if (!input || !input->set_ioproxy(&memory) || !input->open("image." + format, spec, unassociatedAlpha()))
    return {"cannot be decoded: " + (input ? input->geterror() : OIIO::geterror()), ""};
  return readPixels(input.get(), maxPixels, samples);
}

ImageProblem encode(const std::string& format, const std::string& colourSpace, const ImageSamples& samples,
                    std::vector<unsigned char>& bytes) {
  const bool holdsCodes = !samples.codes.empty();
  OIIO::ImageSpec spec(samples.width, samples.height, samples.channels,
                       holdsCodes ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
  spec.attribute("oiio:ColorSpace", colourSpace);
  // Without a date of its own a file takes the time of writing, and equal pixels would not give equal files.
  spec.attribute("DateTime", "2000:01:01 00:00:00");
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  if (!output || !output->supports("ioproxy")) return {"cannot be encoded: OpenImageIO lacks " + format, ""};
  const void* const first =
      holdsCodes ? static_cast<const void*>(samples.codes.data()) : static_cast<const void*>(samples.values.data());
  const bool isEncoded = output->set_ioproxy(&memory) && output->open("image." + format, spec) &&
                         output->write_image(spec.format, first) && output->close();
  if (!isEncoded) return {"cannot be encoded: " + output->geterror(), ""};
  return {};
}

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default"))) const hemitex::radiosity::ImageFunctions hemitexImageFunctions = {
    hemitex::radiosity::read, hemitex::radiosity::decode, hemitex::radiosity::encode};
