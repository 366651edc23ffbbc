#include "radiosity/images/openimageio/bare_images.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <system_error>

namespace hemitex::radiosity {
namespace {

/// A big-endian number.
std::uint64_t numberIn(std::string_view bytes) {
  std::uint64_t number = 0;
  for (const char byte : bytes) number = number << 8 | static_cast<unsigned char>(byte);
  return number;
}

}  // namespace

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

}  // namespace hemitex::radiosity
