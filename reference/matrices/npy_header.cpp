#include "reference/matrices/npy_header.h"

#include <algorithm>

#include "raster/base/input_error.h"
#include "raster/base/short_number.h"

namespace hemitex::reference {
namespace {

constexpr std::string_view magic = "\x93NUMPY";

[[noreturn]] void fail(const std::string& file, const std::string& what) {
  throw raster::InputError(file, 0, "has an array that NumPy did not write: " + what, "save the matrix again");
}

/// The text behind a key of the dictionary.
std::string_view valueOf(std::string_view text, const std::string& key, const std::string& file) {
  const std::size_t at = text.find("'" + key + "':");
  if (at == std::string_view::npos) fail(file, "its header lacks `" + key + "`");
  text.remove_prefix(at + key.size() + 3);
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  return text;
}

/// The text from the start of `text`, which must be `open`, to the next `close`.
std::string_view between(std::string_view text, char open, char close, const std::string& file) {
  const std::size_t end = text.empty() || text.front() != open ? text.npos : text.find(close, 1);
  if (end == std::string_view::npos) fail(file, "its header is damaged");
  return text.substr(1, end - 1);
}

}  // namespace

std::string toBytes(const NpyHeader& header) {
  std::string text = "{'descr': '" + header.type + "', 'fortran_order': False, 'shape': (";
  for (const std::uint64_t size : header.shape) text += std::to_string(size) + (header.shape.size() == 1 ? "," : ", ");
  if (header.shape.size() > 1) text.resize(text.size() - 2);
  text += "), }";
  constexpr std::size_t textBytes = npyHeaderBytes - 10;
  text.resize(textBytes - 1, ' ');
  const std::string version{1, 0, static_cast<char>(textBytes), 0};
  return std::string(magic) + version + text + '\n';
}

std::size_t npyHeaderSize(std::string_view start, const std::string& file) {
  if (!start.starts_with(magic) || start.size() < 12) fail(file, "it does not start with the name of the format");
  const auto byte = [&](std::size_t i) { return std::size_t{static_cast<unsigned char>(start[i])}; };
  const std::size_t version = byte(6);
  if (version < 1 || version > 3) fail(file, "version " + std::to_string(version) + " of the format is unknown");
  return version == 1 ? 10 + byte(8) + (byte(9) << 8)
                      : 12 + byte(8) + (byte(9) << 8) + (byte(10) << 16) + (byte(11) << 24);
}

NpyHeader parseNpyHeader(std::string_view bytes, const std::string& file) {
  NpyHeader header;
  header.type = between(valueOf(bytes, "descr", file), '\'', '\'', file);
  std::string_view sizes = between(valueOf(bytes, "shape", file), '(', ')', file);
  while (!sizes.empty()) {
    const std::size_t length = std::min(sizes.find(','), sizes.size());
    std::string_view size = sizes.substr(0, length);
    size.remove_prefix(std::min(size.find_first_not_of(' '), size.size()));
    sizes.remove_prefix(std::min(length + 1, sizes.size()));
    if (size.empty() && sizes.empty()) break;
    const auto number = raster::parseInteger<std::uint64_t>(size);
    if (!number) fail(file, "its shape is damaged");
    header.shape.push_back(*number);
  }
  return header;
}

}  // namespace hemitex::reference
