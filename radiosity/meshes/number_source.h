/// Numbers of mesh files, in text or binary.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "radiosity/base/text_lines.h"

namespace hemitex::radiosity {

enum class NumberType { Int8, Uint8, Int16, Uint16, Int32, Uint32, Int64, Uint64, Float32, Float64 };
/// The type that a format names, such as `uchar` in PLY, `unsigned_char` in VTK's legacy files and `UInt8` in its XML.
/// Throws InputError for other names.
NumberType typeNamed(std::string_view name, const Place& place);
/// The size of a number in binary files.
std::size_t bytesOf(NumberType type);

enum class NumberEncoding { Text, LittleEndian, BigEndian };

/// Reads numbers one after the other. In text they are separated by blanks and line ends.
class NumberSource {
 public:
  /// `bytes` and the file of `place` must outlive this object. `place` has the line in which the bytes begin, if they
  /// are text.
  NumberSource(std::string_view bytes, NumberEncoding encoding, const Place& place);

  /// The next number. Throws InputError at the end, and for a word that is no finite number.
  double next(NumberType type);
  /// As above, but a number may be infinite or NaN in binary, and a word of a text is NaN if it is no number.
  double nextAny(NumberType type);
  /// The next number as an integer from 0 to `most`. Throws InputError for any other number.
  std::uint32_t nextIndex(NumberType type, std::uint32_t most);
  /// Skips numbers. Throws InputError at the end.
  void skip(NumberType type, std::size_t count);
  /// What has not been read.
  std::string_view rest() const { return bytes_; }
  /// The place of the last number.
  Place place() const { return {file_, line_}; }
  /// Throws InputError unless `count` more numbers can be there, before memory for them is taken.
  void require(NumberType type, std::uint64_t count) const;

 private:
  std::string_view word();

  std::string_view bytes_;
  NumberEncoding encoding_;
  const std::filesystem::path& file_;
  int line_;
};

}  // namespace hemitex::radiosity
