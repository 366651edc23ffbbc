#include "radiosity/meshes/vtk_arrays.h"

#include <zlib.h>

#include <algorithm>

#include "raster/base/input_error.h"
#include "raster/base/memory_budget.h"

namespace hemitex::radiosity {
namespace {

/// The value of a base64 digit; negative for other characters.
int digitOf(char c) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t at = digits.find(c);
  return at == digits.npos ? -1 : static_cast<int>(at);
}

std::string_view withoutBlanks(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  return text;
}

/// The number of base64 characters of a number of bytes, with padding.
std::uint64_t charactersOf(std::uint64_t bytes) { return (bytes + 2) / 3 * 4; }

}  // namespace

std::string fromBase64(std::string_view text, std::uint64_t bytes) {
  std::string result;
  result.reserve(std::min<std::uint64_t>(bytes, text.size()));
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const int digit = digitOf(c);
    if (digit < 0 || result.size() == bytes) break;
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    result += static_cast<char>(bits >> count & 0xff);
  }
  return result;
}

VtkArrays::VtkArrays(const pugi::xml_node& root, std::string_view appended, const std::filesystem::path& file)
    : appendedNode_(root.child("AppendedData")), appended_(appended), file_(file) {
  if (std::string_view(root.attribute("byte_order").value()) == "BigEndian") order_ = NumberEncoding::BigEndian;
  if (std::string_view(root.attribute("header_type").value()) == "UInt64") headerType_ = NumberType::Uint64;
  const std::string_view compressor = root.attribute("compressor").value();
  isCompressed_ = !compressor.empty();
  if (isCompressed_ && compressor != "vtkZLibDataCompressor")
    fail("its arrays are compressed by " + raster::excerpt(compressor));
}

void VtkArrays::fail(const std::string& what) const {
  radiosity::fail({file_}, what, "save the file again, with zlib or without compression");
}

std::uint64_t VtkArrays::headerNumber(std::string_view bytes, std::size_t index) const {
  const std::size_t size = radiosity::bytesOf(headerType_);
  if (bytes.size() < (index + 1) * size) fail("an array ends too early");
  return static_cast<std::uint64_t>(NumberSource(bytes.substr(index * size), order_, {file_}).next(headerType_));
}

/// Plain: the number of bytes, then these. Compressed: the number of blocks, the size of a block and of the last one if
/// it differs, and the compressed size of each; then the blocks. In base64 this header is a text of its own.
std::string VtkArrays::decode(std::string_view text, bool isBase64, std::uint64_t limit) const {
  const std::size_t size = radiosity::bytesOf(headerType_);
  const auto start = [&](std::uint64_t bytes) {
    return isBase64 ? fromBase64(text, bytes)
                    : std::string(text.substr(0, std::min<std::uint64_t>(bytes, text.size())));
  };
  const std::uint64_t first = headerNumber(start(size), 0);
  if (!isCompressed_) {
    if (first > limit + 8 || first > text.size())
      fail("an array has " + std::to_string(first) + " bytes instead of " + std::to_string(limit));
    std::string bytes = start(size + first);
    if (bytes.size() != size + first) fail("an array ends too early");
    return bytes.substr(size);
  }
  if (first > text.size() / size) fail("an array ends too early");
  const std::uint64_t headerBytes = (first + 3) * size;
  const std::string header = start(headerBytes);
  std::uint64_t packedBytes = 0;
  for (std::size_t block = 0; block < first; ++block) {
    const std::uint64_t packed = headerNumber(header, 3 + block);
    if (packed > text.size()) fail("an array ends too early");
    packedBytes += packed;
  }
  text.remove_prefix(std::min<std::uint64_t>(isBase64 ? charactersOf(headerBytes) : headerBytes, text.size()));
  const std::string packed = start(packedBytes);
  if (packed.size() != packedBytes) fail("an array ends too early");
  const std::uint64_t blockBytes = headerNumber(header, 1), lastBytes = headerNumber(header, 2);
  std::string result;
  result.reserve(std::min(limit, raster::saturatedProduct(first, blockBytes)));
  std::size_t at = 0;
  for (std::size_t block = 0; block < first; ++block) {
    const std::uint64_t bytes = block + 1 == first && lastBytes > 0 ? lastBytes : blockBytes;
    if (bytes > limit + 8 - std::min<std::uint64_t>(limit + 8, result.size()))
      fail("an array has more bytes than its mesh needs");
    const std::uint64_t packedSize = headerNumber(header, 3 + block);
    constexpr std::uint64_t highestRatio = 1032;  // of zlib
    if (bytes / highestRatio > packedSize) fail("a compressed array is damaged");
    std::string unpacked(bytes, 0);
    uLongf unpackedBytes = bytes;
    if (uncompress(reinterpret_cast<Bytef*>(unpacked.data()), &unpackedBytes,
                   reinterpret_cast<const Bytef*>(packed.data() + at), packedSize) != Z_OK ||
        unpackedBytes != bytes)
      fail("a compressed array is damaged");
    at += packedSize;
    result += unpacked;
  }
  return result;
}

std::string VtkArrays::bytesOf(const pugi::xml_node& array, std::uint64_t limit) const {
  if (std::string_view(array.attribute("format").value()) != "appended")
    return decode(withoutBlanks(array.text().get()), true, limit);
  const std::uint64_t offset = array.attribute("offset").as_ullong();
  if (offset > appended_.size()) fail("an array begins behind the end of the file");
  return decode(appended_.substr(offset), std::string_view(appendedNode_.attribute("encoding").value()) == "base64",
                limit);
}

std::vector<double> VtkArrays::numbers(const pugi::xml_node& array, std::uint64_t count) const {
  if (!array) fail("an array of the mesh is missing");
  const NumberType type = typeNamed(array.attribute("type").value(), {file_});
  const bool isText = std::string_view(array.attribute("format").value()) == "ascii";
  // The bytes of the array, packed and unpacked, and its numbers.
  raster::requireMemory(raster::saturatedProduct(count, 2 * radiosity::bytesOf(type) + sizeof(double)), file_.string(),
                        "the array " + raster::excerpt(array.attribute("Name").value()));
  const std::string bytes = isText ? std::string(array.text().get())
                                   : bytesOf(array, raster::saturatedProduct(count, radiosity::bytesOf(type)));
  NumberSource source(bytes, isText ? NumberEncoding::Text : order_, {file_});
  source.require(type, count);
  std::vector<double> result(count);
  for (double& number : result) number = source.next(type);
  return result;
}

std::vector<std::uint32_t> VtkArrays::indices(const pugi::xml_node& array, std::uint64_t count,
                                              std::uint32_t most) const {
  std::vector<std::uint32_t> result;
  for (const double number : numbers(array, count)) {
    if (!(number >= 0 && number <= most) || number != static_cast<std::uint32_t>(number))
      fail("an index of its mesh is out of range");
    result.push_back(static_cast<std::uint32_t>(number));
  }
  return result;
}

}  // namespace hemitex::radiosity
