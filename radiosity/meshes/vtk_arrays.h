/// The arrays of VTK's XML files: text, base64 or appended bytes, plain or compressed by zlib.
/// Source: VTK File Formats (Kitware), section XML Formats, and https://docs.vtk.org, VTKFileFormat.
#pragma once

#include <filesystem>
#include <pugixml.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "radiosity/meshes/number_source.h"

namespace hemitex::radiosity {

class VtkArrays {
 public:
  /// `root` is the element VTKFile, and `appended` the bytes behind the underscore of AppendedData. All must outlive
  /// this object. Throws InputError for a compressor that is not read.
  VtkArrays(const pugi::xml_node& root, std::string_view appended, const std::filesystem::path& file);

  /// The `count` numbers of an element DataArray, finite. Throws InputError if it is missing or has fewer.
  std::vector<double> numbers(const pugi::xml_node& array, std::uint64_t count) const;
  /// As above, integers from 0 to `most`.
  std::vector<std::uint32_t> indices(const pugi::xml_node& array, std::uint64_t count, std::uint32_t most) const;

 private:
  std::string bytesOf(const pugi::xml_node& array, std::uint64_t limit) const;
  std::string decode(std::string_view text, bool isBase64, std::uint64_t limit) const;
  std::uint64_t headerNumber(std::string_view bytes, std::size_t index) const;
  [[noreturn]] void fail(const std::string& what) const;

  pugi::xml_node appendedNode_;
  std::string_view appended_;
  const std::filesystem::path& file_;
  NumberEncoding order_ = NumberEncoding::LittleEndian;
  NumberType headerType_ = NumberType::Uint32;
  bool isCompressed_ = false;
};

/// The bytes of a base64 text, which ends before the first character of another kind, and after `bytes` bytes.
std::string fromBase64(std::string_view text, std::uint64_t bytes);

}  // namespace hemitex::radiosity
