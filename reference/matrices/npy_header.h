/// The header of an array in NumPy's `.npy` format, versions 1 to 3.
/// Source: NumPy Enhancement Proposal 1, and the module numpy.lib.format.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace hemitex::reference {

struct NpyHeader {
  std::string type;                       ///< NumPy's name, such as `<f8`
  std::vector<std::uint64_t> shape = {};  ///< empty for a single value
};

/// The size of every header that toBytes makes.
inline constexpr std::size_t npyHeaderBytes = 128;

/// The bytes of a header, of version 1.
std::string toBytes(const NpyHeader& header);

/// The number of bytes of the header that starts with `start`, which has at least 12 bytes. Throws InputError, which
/// names `file`, for bytes that are none.
std::size_t npyHeaderSize(std::string_view start, const std::string& file);

/// Parses the bytes of a header. The order of axes is ignored: arrays here have one. Throws InputError, which names
/// `file`, for damaged headers.
NpyHeader parseNpyHeader(std::string_view bytes, const std::string& file);

}  // namespace hemitex::reference
