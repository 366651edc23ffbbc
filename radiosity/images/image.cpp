#include "radiosity/images/image.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <type_traits>

#include "radiosity/images/image_module.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::radiosity {

static_assert(std::is_nothrow_move_constructible_v<Image>);

namespace {

/// As `open`, which opens a module. Throws InputError where the module is not found.
template <typename Functions>
const Functions& functionsFor(const std::filesystem::path& file, const Functions& (*open)()) try {
  return open();
} catch (const raster::InputError&) {
  throw;
} catch (const std::runtime_error& error) {
  throw raster::InputError(file.string(), 0,
                           std::string("needs the module for images, which cannot be opened: ") + error.what(),
                           "install hemitex again, or build it with CMake");
}

void throwIfAny(const ImageProblem& problem, const std::filesystem::path& file) {
  if (!problem.problem.empty()) throw raster::InputError(file.string(), 0, problem.problem, problem.advice);
}

std::vector<unsigned char> encoded(Encoder encode, const ImageSamples& samples, const std::filesystem::path& file) {
  std::vector<unsigned char> bytes;
  throwIfAny(encode(samples, bytes), file);
  return bytes;
}

void writeBytes(const std::filesystem::path& file, const std::vector<unsigned char>& bytes) {
  raster::writeFile(file, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// A value of an EXR file. Throws InputError for a value that 32-bit floats cannot hold.
float floatOf(double value, const std::filesystem::path& file) {
  if (value > std::numeric_limits<float>::max())
    throw raster::InputError(file.string(), 0, "cannot hold a value above 3.4e38", "scale the light down");
  return static_cast<float>(value);
}

/// In a file, and in memory.
constexpr std::uint64_t maxPixels = std::uint64_t{1} << 28, maxKeptPixels = std::uint64_t{1} << 24;

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

constexpr std::size_t lowerCodes = 4096;

/// The codes of 0, 1/4096, 2/4096, ... Codes of linear values between them are at most a few steps above.
std::array<std::uint8_t, lowerCodes> codesOfLowerValues(const std::array<double, 255>& thresholds) {
  std::array<std::uint8_t, lowerCodes> codes;
  for (std::size_t i = 0; i < lowerCodes; ++i) {
    const double linear = static_cast<double>(i) / lowerCodes;
    const auto above = std::upper_bound(thresholds.begin(), thresholds.end(), linear);
    codes[i] = static_cast<std::uint8_t>(above - thresholds.begin());
  }
  return codes;
}

const std::array<double, 256>& decodedCodes() {
  static const std::array<double, 256> decoded = [] {
    std::array<double, 256> values;
    for (int code = 0; code < 256; ++code) values[static_cast<std::size_t>(code)] = decodeSrgb(code / 255.0);
    return values;
  }();
  return decoded;
}

/// The pixel of an image at an index.
glm::dvec3 pixelAt(const Image& image, std::size_t pixel) { return image.pixels[pixel]; }

glm::dvec3 pixelAt(const CodedImage& image, std::size_t pixel) {
  const std::array<double, 256>& decoded = decodedCodes();
  const std::uint8_t* const codes = &image.codes[3 * pixel];
  return {decoded[codes[0]], decoded[codes[1]], decoded[codes[2]]};
}

template <typename AnyImage>
glm::dvec3 bilinearIn(const AnyImage& image, const glm::dvec2& uv) {
  const glm::dvec2 place = nearPlace(image.sampler(uv), image.sampler.wrap);
  const double x = place.x * image.width - 0.5, y = (1 - place.y) * image.height - 0.5;
  const int column = static_cast<int>(std::floor(x)), row = static_cast<int>(std::floor(y));
  const auto at = [&](int c, int r) {
    return pixelAt(image, wrappedPixel(image.width, image.height, image.sampler.wrap, c, image.height - 1 - r));
  };
  return glm::mix(glm::mix(at(column, row), at(column + 1, row), x - column),
                  glm::mix(at(column, row + 1), at(column + 1, row + 1), x - column), y - row);
}

/// The cell of one period that an image shows at a cell of an axis.
std::size_t wrappedCell(std::int64_t cell, std::int64_t size, Wrap wrap) {
  if (cell >= 0 && cell < size) return static_cast<std::size_t>(cell);
  if (wrap == Wrap::Clamp) return static_cast<std::size_t>(std::clamp<std::int64_t>(cell, 0, size - 1));
  const std::int64_t period = wrap == Wrap::Mirror ? 2 * size : size, within = (cell % period + period) % period;
  return static_cast<std::size_t>(within < size ? within : period - 1 - within);
}

/// Makes an image of rows, with linear values. A larger one than is kept is reduced while its rows arrive: its sides
/// are divided by the smallest power of two that makes it small enough, rounded up, and each new pixel is the mean of
/// the pixels that it covers.
class RowCollector {
 public:
  explicit RowCollector(const std::filesystem::path& file) : file_(file) {}

  /// Throws InputError, with the name of the file, for a value that is not finite.
  void add(const ImageSamples& rows, int height) {
    if (image_.width == 0) begin(rows, height);
    if (!rows.codes.empty()) {
      const std::array<double, 256>& decoded = decodedCodes();
      addRows(rows, rows.codes, [&](std::uint8_t code) { return decoded[code]; });
    } else {
      addRows(rows, rows.values, [](float value) { return static_cast<double>(value); });
    }
  }

  Image image() && {
    if (std::all_of(image_.alpha.begin(), image_.alpha.end(), [](float alpha) { return alpha >= 1; }))
      image_.alpha = {};
    return std::move(image_);
  }

 private:
  /// Some decoders need memory for the whole image as it is in the file.
  void begin(const ImageSamples& rows, int height) {
    const int width = rows.width;
    sourceWidth_ = width;
    sourceHeight_ = height;
    int shift = 0;
    const auto reduced = [&shift](int length) { return ((length - 1) >> shift) + 1; };
    while (pixelsOf(reduced(width), reduced(height)) > maxKeptPixels) ++shift;
    image_.width = reduced(width);
    image_.height = reduced(height);
    raster::requireMemory(sizeof(glm::dvec3) * pixelsOf(image_.width, image_.height) +
                              static_cast<std::uint64_t>(rows.channels) * pixelsOf(width, height),
                          file_.string(),
                          "the image of " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                          "scale it down");
    sums_.resize(static_cast<std::size_t>(image_.width));
    alphaSums_.resize(rows.channels % 2 == 0 ? sums_.size() : 0);
    counts_.resize(sums_.size());
    image_.pixels.reserve(sums_.size() * static_cast<std::size_t>(image_.height));
  }

  static std::uint64_t pixelsOf(int width, int height) {
    return static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  }

  /// The new row or column of an old one.
  static int covering(int old, int length, int reduced) {
    return static_cast<int>(std::int64_t{old} * reduced / length);
  }

  template <typename Sample, typename Decode>
  void addRows(const ImageSamples& rows, const std::vector<Sample>& samples, const Decode& decode) {
    const auto stride = static_cast<std::size_t>(rows.channels);
    const bool hasAlpha = stride % 2 == 0;
    const Sample* s = samples.data();
    for (int row = 0; row < rows.height; ++row) {
      for (int column = 0; column < rows.width; ++column, s += stride) {
        const glm::dvec3 pixel =
            stride < 3 ? glm::dvec3(decode(s[0])) : glm::dvec3(decode(s[0]), decode(s[1]), decode(s[2]));
        if (!std::isfinite(pixel.r + pixel.g + pixel.b))
          throw raster::InputError(file_.string(), 0, "holds a value that is not finite", "repair the image");
        const auto place = static_cast<std::size_t>(covering(column, sourceWidth_, image_.width));
        if (hasAlpha) alphaSums_[place] = (counts_[place] == 0 ? 0 : alphaSums_[place]) + alphaOf(s[stride - 1]);
        sums_[place] = counts_[place]++ == 0 ? pixel : sums_[place] + pixel;
      }
      endRow();
    }
  }

  /// Appends the row of means if the next row belongs to another one.
  void endRow() {
    ++row_;
    if (row_ < sourceHeight_ &&
        covering(row_, sourceHeight_, image_.height) == covering(row_ - 1, sourceHeight_, image_.height))
      return;
    for (std::size_t i = 0; i < sums_.size(); ++i) {
      image_.pixels.push_back(counts_[i] == 1 ? sums_[i] : sums_[i] / static_cast<double>(counts_[i]));
      if (!alphaSums_.empty()) image_.alpha.push_back(alphaSums_[i] / static_cast<float>(counts_[i]));
      counts_[i] = 0;
    }
  }

  static float alphaOf(std::uint8_t code) { return static_cast<float>(code) / 255; }
  static float alphaOf(float value) { return value; }

  const std::filesystem::path& file_;
  Image image_;
  int sourceWidth_ = 0, sourceHeight_ = 0;
  int row_ = 0;                   ///< rows so far
  std::vector<glm::dvec3> sums_;  ///< per pixel of the present row of the image
  std::vector<float> alphaSums_;  ///< as sums_; empty without alpha
  std::vector<int> counts_;
};

}  // namespace

double decodeSrgb(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  const double x = (encoded + 0.055) / 1.055;
  return x * x * fifthRoot(x * x);  // x^2.4
}

glm::dvec3 decodeSrgb(const glm::dvec3& encoded) {
  const glm::dvec3 clamped = glm::clamp(encoded, 0.0, 1.0);
  return {decodeSrgb(clamped.x), decodeSrgb(clamped.y), decodeSrgb(clamped.z)};
}

std::uint8_t encodeSrgb(double linear) {
  static const std::array<double, 255> thresholds = codeThresholds();
  static const std::array<std::uint8_t, lowerCodes> lower = codesOfLowerValues(thresholds);
  if (!(linear > 0)) return 0;
  if (linear >= 1) return 255;
  std::uint8_t code = lower[static_cast<std::size_t>(linear * lowerCodes)];
  while (code < 255 && thresholds[code] <= linear) ++code;
  return code;
}

CodedImage encodeSrgb(const Image& image) {
  CodedImage coded{image.width, image.height, {}, image.sampler};
  coded.codes.reserve(3 * image.pixels.size());
  for (const glm::dvec3& pixel : image.pixels)
    for (int band = 0; band < 3; ++band) coded.codes.push_back(encodeSrgb(pixel[band]));
  return coded;
}

Image decodeSrgb(const CodedImage& image) {
  Image decoded{image.width, image.height, {}, image.sampler};
  decoded.pixels.reserve(image.codes.size() / 3);
  for (std::size_t pixel = 0; pixel < image.codes.size() / 3; ++pixel) decoded.pixels.push_back(pixelAt(image, pixel));
  return decoded;
}

std::size_t wrappedPixel(int width, int height, const std::array<Wrap, 2>& wrap, std::int64_t column,
                         std::int64_t row) {
  return (static_cast<std::size_t>(height) - 1 - wrappedCell(row, height, wrap[1])) * static_cast<std::size_t>(width) +
         wrappedCell(column, width, wrap[0]);
}

glm::dvec2 nearPlace(const glm::dvec2& place, const std::array<Wrap, 2>& wrap) {
  const auto near = [](double at, Wrap along) {
    if (along == Wrap::Clamp) return std::clamp(at, 0.0, 1.0);
    return along == Wrap::Mirror ? at - 2 * std::floor(at / 2) : at - std::floor(at);
  };
  return {near(place.x, wrap[0]), near(place.y, wrap[1])};
}

glm::dvec3 bilinear(const Image& image, const glm::dvec2& uv) { return bilinearIn(image, uv); }
glm::dvec3 bilinear(const CodedImage& image, const glm::dvec2& uv) { return bilinearIn(image, uv); }

Image readImage(const std::filesystem::path& file) {
  std::array<char, 4> start{};
  const raster::InputFile opened = raster::openFile(file);  // OpenImageIO would wait for a pipe
  const std::string_view found(start.data(), std::fread(start.data(), 1, start.size(), opened.get()));
  if (found == "\x89PNG" || found.starts_with("\xff\xd8")) {
    const std::string bytes = raster::readFile(file);
    return decodeImage({bytes.begin(), bytes.end()}, file);
  }
  RowCollector collector(file);
  const auto receive = [&collector](const ImageSamples& rows, int height) { collector.add(rows, height); };
  throwIfAny(functionsFor(file, imageFunctions).read(file.string(), maxPixels, receive), file);
  return std::move(collector).image();
}

Image decodeImage(const std::vector<unsigned char>& bytes, const std::filesystem::path& name) {
  RowCollector collector(name);
  const auto receive = [&collector](const ImageSamples& rows, int height) { collector.add(rows, height); };
  throwIfAny(functionsFor(name, imageFunctions).decode(bytes, maxPixels, receive), name);
  return std::move(collector).image();
}

std::vector<unsigned char> encodePng(const CodedImage& image, const std::filesystem::path& file) {
  ImageSamples samples{image.width, image.height, 3, image.codes};
  if (!image.isHole.empty()) {
    samples.channels = 4;
    samples.codes.clear();
    for (std::size_t pixel = 0; pixel < image.isHole.size(); ++pixel) {
      samples.codes.insert(samples.codes.end(), &image.codes[3 * pixel], &image.codes[3 * pixel] + 3);
      samples.codes.push_back(image.isHole[pixel] ? 0 : 255);
    }
  }
  return encoded(functionsFor(file, imageEncoders).png, samples, file);
}

void writePng(const std::filesystem::path& file, const Image& image) {
  writeBytes(file, encodePng(encodeSrgb(image), file));
}

void writeExr(const std::filesystem::path& file, const Image& image) {
  ChannelImage channels{image.width, image.height, {"R", "G", "B"}, {}};
  for (const glm::dvec3& pixel : image.pixels)
    channels.values.insert(channels.values.end(), {pixel.r, pixel.g, pixel.b});
  writeExr(file, channels);
}

void writeExr(const std::filesystem::path& file, const ChannelImage& image) {
  ImageSamples samples{image.width, image.height, static_cast<int>(image.channels.size()), {}, {}, image.channels};
  samples.values.reserve(image.values.size());
  for (const double value : image.values) samples.values.push_back(floatOf(value, file));
  writeBytes(file, encoded(functionsFor(file, imageEncoders).exr, samples, file));
}

}  // namespace hemitex::radiosity
