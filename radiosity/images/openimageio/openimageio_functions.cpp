/// The module hemitex_images: image files by OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

#include "radiosity/images/image_module.h"

namespace hemitex::radiosity {
namespace {

/// A big-endian number.
std::uint64_t numberIn(std::string_view bytes) {
  std::uint64_t number = 0;
  for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

// Image files without what their readers may fail at. OpenImageIO 2.4 reads beyond the text that cameras put into JPEG
// files, and libpng and OpenEXR take the memory that a part of a file promises, up to 2 GiB, before they read it.

/// A PNG file with nothing but what its pixels need: no texts, dates, profiles and previews. What follows a part that
/// is cut off is left out.
std::vector<unsigned char> barePng(std::string_view bytes) {
  constexpr std::array<std::string_view, 5> needed{"IHDR", "PLTE", "tRNS", "IDAT", "IEND"};
  constexpr std::size_t signature = 8, frame = 12;  // of a chunk: its length, name and checksum
  std::vector<unsigned char> bare(bytes.begin(), bytes.begin() + std::min(bytes.size(), signature));
  for (bytes.remove_prefix(bare.size()); bytes.size() >= frame;) {
    const std::uint64_t length = frame + numberIn(bytes.substr(0, 4));
    if (length > bytes.size()) break;
    if (std::find(needed.begin(), needed.end(), bytes.substr(4, 4)) != needed.end())
      bare.insert(bare.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    bytes.remove_prefix(length);
  }
  return bare;
}

/// As barePng for a JPEG file.
std::vector<unsigned char> bareJpeg(std::string_view bytes) {
  constexpr unsigned char firstOfTwoBytes = 0xd0, lastOfTwoBytes = 0xd9, scan = 0xda, jfif = 0xe0, adobe = 0xee,
                          lastApplication = 0xef, comment = 0xfe;
  std::vector<unsigned char> bare;
  while (true) {
    // As decoders do: bytes before a marker are skipped.
    bytes.remove_prefix(std::min(bytes.find('\xff'), bytes.size()));
    while (bytes.size() > 2 && bytes[1] == '\xff') bytes.remove_prefix(1);
    if (bytes.size() < 2) return bare;
    const auto marker = static_cast<unsigned char>(bytes[1]);
    std::size_t length = 2;
    if (marker == scan) {
      length = bytes.size();
    } else if (marker > 1 && (marker < firstOfTwoBytes || marker > lastOfTwoBytes)) {
      if (bytes.size() < 4) return bare;
      length += numberIn(bytes.substr(2, 2));
    }
    if (length > bytes.size()) return bare;
    const bool isText = (marker > jfif && marker <= lastApplication && marker != adobe) || marker == comment;
    if (!isText && marker != 0)
      bare.insert(bare.end(), bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(length));
    bytes.remove_prefix(length);
  }
}

/// Whether an EXR file is at least as long as the attributes in its headers.
bool holdsItsAttributes(const std::string& exr) {
  std::error_code ignored;
  const std::uintmax_t size = std::filesystem::file_size(exr, ignored);
  std::ifstream stream(exr, std::ios::binary);
  std::array<char, 8> start{};  // the magic number, and flags
  stream.read(start.data(), start.size());
  const bool hasParts = (start[5] & 0x10) != 0;
  bool isEmpty = true;  // the present header, so far
  for (std::string name, type; std::getline(stream, name, '\0');) {
    if (name.empty()) {  // ends a header, and in a file of parts the list of headers
      if (!hasParts || isEmpty) return true;
      isEmpty = true;
      continue;
    }
    isEmpty = false;
    std::int32_t bytes = 0;
    std::getline(stream, type, '\0').read(reinterpret_cast<char*>(&bytes), sizeof bytes);
    if (!stream || bytes < 0 || static_cast<std::uintmax_t>(bytes) > size - static_cast<std::uintmax_t>(stream.tellg()))
      return false;
    stream.seekg(bytes, std::ios::cur);
  }
  return false;
}

/// Alpha is apart from colours, which must not be multiplied by it.
OIIO::ImageSpec unassociatedAlpha() {
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  return config;
}

/// The maximum size of what is decoded at a time: rows, or a row of tiles.
constexpr std::uint64_t maxBytesAtOnce = std::uint64_t{1} << 28;

/// The number of rows to decode at a time: those of a tile, or about 2^22 samples.
int rowsAtOnce(const OIIO::ImageSpec& spec, int channels) {
  if (spec.tile_height > 0) return std::min(spec.tile_height, spec.height);
  const std::int64_t samplesPerRow = std::int64_t{spec.width} * channels;
  return static_cast<int>(std::clamp<std::int64_t>((1 << 22) / samplesPerRow, 1, spec.height));
}

/// Decodes rows [begin, end). False if the file is broken.
template <typename Sample>
bool readRows(OIIO::ImageInput* input, int begin, int end, OIIO::TypeDesc type, ImageSamples& rows,
              std::vector<Sample>& samples) {
  const OIIO::ImageSpec& spec = input->spec();
  rows.height = end - begin;
  samples.resize(static_cast<std::size_t>(rows.width) * static_cast<std::size_t>(rows.height) *
                 static_cast<std::size_t>(rows.channels));
  begin += spec.y;
  end += spec.y;
  if (spec.tile_width == 0)
    return input->read_scanlines(0, 0, begin, end, spec.z, 0, rows.channels, type, samples.data());
  return input->read_tiles(0, 0, spec.x, spec.x + spec.width, begin, end, spec.z, spec.z + 1, 0, rows.channels, type,
                           samples.data());
}

/// Reads the pixels of an image that is open. Memory grows with the rows that the file holds, not with what its header
/// promises.
ImageProblem readPixels(OIIO::ImageInput* input, std::uint64_t maxPixels, const RowReceiver& receive) {
  const OIIO::ImageSpec& spec = input->spec();
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0) return {"cannot be read: it has no pixels", ""};
  if (spec.image_pixels() > maxPixels) return {"has too many pixels", "scale it down to at most 16384 x 16384"};
  const int colours = spec.nchannels < 3 ? 1 : 3;
  ImageSamples rows{spec.width, 0, colours + (spec.alpha_channel == colours ? 1 : 0)};
  const int step = rowsAtOnce(spec, rows.channels);
  if (static_cast<std::uint64_t>(step) * spec.scanline_bytes(true) > maxBytesAtOnce)
    return {"has tiles or rows of more than 256 MiB", "save it with smaller tiles"};
  receive(rows, spec.height);  // before a decoder takes memory for the whole image
  for (int begin = 0; begin < spec.height; begin += step) {
    const int end = std::min(begin + step, spec.height);
    const bool isRead = spec.format == OIIO::TypeDesc::UINT8
                            ? readRows(input, begin, end, OIIO::TypeDesc::UINT8, rows, rows.codes)
                            : readRows(input, begin, end, OIIO::TypeDesc::FLOAT, rows, rows.values);
    if (!isRead) return {"is damaged", "save it again"};
    receive(rows, spec.height);
  }
  return {};
}

/// OpenImageIO's name of the format that the first bytes of a file say, or else the end of its name. OpenImageIO itself
/// offers a file that its format does not fit to the readers of all formats, also to those of videos.
std::string formatOf(const std::string& file) {
  std::array<char, 4> start{};
  std::ifstream(file, std::ios::binary).read(start.data(), start.size());
  const bool isExr = std::string_view(start.data(), start.size()) == "\x76\x2f\x31\x01";
  return isExr ? "openexr" : OIIO::Filesystem::extension(file, false);
}

ImageProblem read(const std::string& file, std::uint64_t maxPixels, const RowReceiver& receive) {
  const std::string format = formatOf(file);
  if (format == "openexr" && !holdsItsAttributes(file))
    return {"is cut off: its header promises more", "save it again"};
  const auto input = format.empty() ? nullptr : OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec;
  if (!input || !input->open(file, spec, unassociatedAlpha()))
    return {"cannot be read as an image", "save it as PNG, JPEG or EXR"};
  return readPixels(input.get(), maxPixels, receive);
}

ImageProblem decode(const std::vector<unsigned char>& bytes, std::uint64_t maxPixels, const RowReceiver& receive) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const bool isPng = text.starts_with("\x89PNG"),
             isWebP = text.size() >= 12 && text.starts_with("RIFF") && text.substr(8, 4) == "WEBP";
  if (!isPng && !isWebP && !text.starts_with("\xff\xd8"))
    return {"is neither PNG nor JPEG nor WebP", "export it as PNG"};
  const std::string format = isPng ? "png" : isWebP ? "webp" : "jpeg";
  std::vector<unsigned char> bare = isPng ? barePng(text) : isWebP ? bytes : bareJpeg(text);
  OIIO::Filesystem::IOMemReader memory(bare.data(), bare.size());
  const auto input = OIIO::ImageInput::create(format);
  OIIO::ImageSpec spec;
  if (!input || !input->set_ioproxy(&memory) || !input->open("image." + format, spec, unassociatedAlpha()))
    return {"cannot be decoded", "export it as PNG"};
  return readPixels(input.get(), maxPixels, receive);
}

}  // namespace
}  // namespace hemitex::radiosity

extern "C" __attribute__((visibility("default"))) const hemitex::radiosity::ImageFunctions hemitexImageFunctions = {
    hemitex::radiosity::read, hemitex::radiosity::decode};
