#include "radiosity/meshes/number_source.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

template <typename Number>
double numberIn(std::array<char, 8> bytes, std::size_t size) {
  Number number = 0;
  std::memcpy(&number, bytes.data(), size);
  return static_cast<double>(number);
}

const std::string giveWhole = "give the whole file";

}  // namespace

NumberType typeNamed(std::string_view name, const Place& place) {
  // The names of each type, in the order of NumberType, each between blanks.
  constexpr std::array<std::string_view, 10> names{" Int8 int8 char ",
                                                   " UInt8 uint8 uchar unsigned_char ",
                                                   " Int16 int16 short ",
                                                   " UInt16 uint16 ushort unsigned_short ",
                                                   " Int32 int32 int ",
                                                   " UInt32 uint32 uint unsigned_int ",
                                                   " Int64 long vtktypeint64 vtkIdType ",
                                                   " UInt64 ",
                                                   " Float32 float32 float ",
                                                   " Float64 float64 double "};
  const std::string word = " " + std::string(name) + " ";
  const auto found = std::find_if(names.begin(), names.end(),
                                  [&](std::string_view list) { return list.find(word) != std::string_view::npos; });
  if (found == names.end() || name.find(' ') != name.npos)
    fail(place, "'" + raster::excerpt(name) + "' is not a type of numbers that is read");
  return static_cast<NumberType>(found - names.begin());
}

std::size_t bytesOf(NumberType type) {
  constexpr std::array<std::size_t, 10> sizes{1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}

NumberSource::NumberSource(std::string_view bytes, NumberEncoding encoding, const Place& place)
    : bytes_(bytes), encoding_(encoding), file_(place.file), line_(place.line) {}

/// The next word of a text.
std::string_view NumberSource::word() {
  constexpr std::string_view blanks = " \t\r\n\v\f";
  const std::size_t begin = std::min(bytes_.find_first_not_of(blanks), bytes_.size());
  line_ += static_cast<int>(std::count(bytes_.begin(), bytes_.begin() + static_cast<std::ptrdiff_t>(begin), '\n'));
  bytes_.remove_prefix(begin);
  if (bytes_.empty()) fail(place(), "the file ends where a number is missing", giveWhole);
  const std::string_view found = bytes_.substr(0, std::min(bytes_.find_first_of(blanks), bytes_.size()));
  bytes_.remove_prefix(found.size());
  return found;
}

double NumberSource::next(NumberType type) {
  if (encoding_ == NumberEncoding::Text) {
    const std::string_view text = word();
    return readNumber(text, place());
  }
  const double number = nextAny(type);
  if (!std::isfinite(number)) fail(place(), "a number is not finite");
  return number;
}

double NumberSource::nextAny(NumberType type) {
  if (encoding_ == NumberEncoding::Text) return numberOf(word()).value_or(std::numeric_limits<double>::quiet_NaN());
  const std::size_t size = bytesOf(type);
  if (bytes_.size() < size) fail(place(), "the file ends where a number is missing", giveWhole);
  std::array<char, 8> bytes{};
  std::copy_n(bytes_.begin(), size, bytes.begin());
  bytes_.remove_prefix(size);
  const bool isNative = (encoding_ == NumberEncoding::LittleEndian) == (std::endian::native == std::endian::little);
  if (!isNative) std::reverse(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
  constexpr std::array readers{numberIn<std::int8_t>,   numberIn<std::uint8_t>,  numberIn<std::int16_t>,
                               numberIn<std::uint16_t>, numberIn<std::int32_t>,  numberIn<std::uint32_t>,
                               numberIn<std::int64_t>,  numberIn<std::uint64_t>, numberIn<float>,
                               numberIn<double>};
  return readers[static_cast<std::size_t>(type)](bytes, size);
}

std::uint32_t NumberSource::nextIndex(NumberType type, std::uint32_t most) {
  const double number = next(type);
  if (!(number >= 0 && number <= most && number == std::floor(number)))
    fail(place(), "a number should be an integer from 0 to " + std::to_string(most), giveWhole);
  return static_cast<std::uint32_t>(number);
}

void NumberSource::skip(NumberType type, std::size_t count) {
  require(type, count);
  if (encoding_ != NumberEncoding::Text) return bytes_.remove_prefix(count * bytesOf(type));
  for (std::size_t i = 0; i < count; ++i) word();
}

void NumberSource::require(NumberType type, std::uint64_t count) const {
  const std::uint64_t size = encoding_ == NumberEncoding::Text ? 1 : bytesOf(type);
  if (count > bytes_.size() / size)
    fail(place(), "the file ends where " + std::to_string(count) + " numbers begin", giveWhole);
}

}  // namespace hemitex::radiosity
