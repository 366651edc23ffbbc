#include "radiosity/scene/image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

constexpr std::uint64_t maxPixels = std::uint64_t{1} << 28;

/// a^(1/5) for a in [0.001, 1], the real root of y^5 = a, by Newton's iteration y <- (4 y + a / y^4) / 5. From y = 1 it
/// decreases by at most a fifth per step, then doubles its digits. So y is below 0.26 after at most six steps, and has
/// all 53 bits after five more.
double fifthRoot(double a) {
  double y = 1;
  for (int step = 0; step < 14; ++step) y = (4 * y + a / (y * y * y * y)) / 5;
  return y;
}

/// Threshold k, counted from 1: linear values from there on are nearer to code k than to code k - 1.
std::array<double, 255> codeThresholds() {
  std::array<double, 255> thresholds;
  for (int k = 1; k <= 255; ++k) thresholds[static_cast<std::size_t>(k - 1)] = decodeSrgb((k - 0.5) / 255);
  return thresholds;
}

std::array<double, 256> decodedCodes() {
  std::array<double, 256> values;
  for (int code = 0; code < 256; ++code) values[static_cast<std::size_t>(code)] = decodeSrgb(code / 255.0);
  return values;
}

/// Reads samples of one type, decodes them, and converts them to three channels. Returns no pixels if the reader fails.
template <typename Sample, typename Decode>
std::vector<glm::dvec3> readPixels(OIIO::ImageInput& input, OIIO::TypeDesc type, const Decode& decode) {
  const OIIO::ImageSpec& spec = input.spec();
  const auto channels = static_cast<std::size_t>(spec.nchannels);
  std::vector<Sample> samples(spec.image_pixels() * channels);
  if (!input.read_image(0, 0, 0, spec.nchannels, type, samples.data())) return {};
  std::vector<glm::dvec3> pixels;
  pixels.reserve(samples.size() / channels);
  for (std::size_t first = 0; first < samples.size(); first += channels) {
    const Sample* s = &samples[first];
    pixels.push_back(channels < 3 ? glm::dvec3(decode(s[0])) : glm::dvec3(decode(s[0]), decode(s[1]), decode(s[2])));
  }
  return pixels;
}

std::vector<glm::dvec3> readLinearPixels(OIIO::ImageInput& input) {
  if (input.spec().format != OIIO::TypeDesc::UINT8)
    return readPixels<float>(input, OIIO::TypeDesc::FLOAT, [](float value) { return static_cast<double>(value); });
  const std::array<double, 256> decoded = decodedCodes();
  return readPixels<std::uint8_t>(input, OIIO::TypeDesc::UINT8, [&](std::uint8_t code) { return decoded[code]; });
}

OIIO::ImageSpec rgbSpec(const Image& image, OIIO::TypeDesc format, const std::string& colourSpace) {
  OIIO::ImageSpec spec(image.width, image.height, 3, format);
  spec.attribute("oiio:ColorSpace", colourSpace);
  // The default is the time of writing, which would make files with equal pixels differ.
  spec.attribute("DateTime", "2000:01:01 00:00:00");
  return spec;
}

/// Encodes in memory, so that a full disk is detected when the bytes are written, whatever the encoder does.
void writeEncoded(const std::filesystem::path& file, const std::string& format, const OIIO::ImageSpec& spec,
                  const void* samples) {
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput memory(bytes);
  const auto output = OIIO::ImageOutput::create(format);
  assert(output && output->supports("ioproxy"));
  const bool encoded = output->set_ioproxy(&memory) && output->open(file.string(), spec) &&
                       output->write_image(spec.format, samples) && output->close();
  if (!encoded) throw raster::InputError(file.string(), 0, "cannot be encoded: " + output->geterror());
  raster::writeFile(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

}  // namespace

double decodeSrgb(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  const double x = (encoded + 0.055) / 1.055;
  return x * x * fifthRoot(x * x);  // x^2.4
}

std::uint8_t encodeSrgb(double linear) {
  static const std::array<double, 255> thresholds = codeThresholds();
  const auto above =
      std::partition_point(thresholds.begin(), thresholds.end(), [&](double threshold) { return threshold <= linear; });
  return static_cast<std::uint8_t>(above - thresholds.begin());
}

Image readImage(const std::filesystem::path& file) {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);  // alpha is dropped, so that colours must not be multiplied by it
  const auto input = OIIO::ImageInput::open(file.string(), &config);
  if (!input) throw raster::InputError(file.string(), 0, "cannot be read as an image: " + OIIO::geterror());
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.image_pixels() > maxPixels)
    throw raster::InputError(file.string(), 0, "has too many pixels", "scale it down to at most 16384 x 16384");
  const Image image{spec.width, spec.height, readLinearPixels(*input)};
  if (image.pixels.empty()) throw raster::InputError(file.string(), 0, "cannot be read: " + input->geterror());
  const auto isFinite = [](const glm::dvec3& p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  if (!std::all_of(image.pixels.begin(), image.pixels.end(), isFinite))
    throw raster::InputError(file.string(), 0, "holds a value that is not finite", "repair the image");
  return image;
}

void writePng(const std::filesystem::path& file, const Image& image) {
  std::vector<std::uint8_t> codes;
  codes.reserve(3 * image.pixels.size());
  for (const glm::dvec3& pixel : image.pixels)
    for (int band = 0; band < 3; ++band) codes.push_back(encodeSrgb(pixel[band]));
  writeEncoded(file, "png", rgbSpec(image, OIIO::TypeDesc::UINT8, "sRGB"), codes.data());
}

void writeExr(const std::filesystem::path& file, const Image& image) {
  std::vector<float> values;
  values.reserve(3 * image.pixels.size());
  for (const glm::dvec3& pixel : image.pixels)
    for (int band = 0; band < 3; ++band) {
      if (pixel[band] > std::numeric_limits<float>::max())
        throw raster::InputError(file.string(), 0, "cannot hold a value above 3.4e38", "scale the light down");
      values.push_back(static_cast<float>(pixel[band]));
    }
  writeEncoded(file, "openexr", rgbSpec(image, OIIO::TypeDesc::FLOAT, "Linear"), values.data());
}

}  // namespace hemitex::radiosity
