#include "raster/base/input_error.h"

#include <algorithm>

#include "raster/base/printable_text.h"

namespace hemitex::raster {
namespace {

std::string message(const std::string& file, int line, const std::string& what, const std::string& advice) {
  std::string text;
  if (!file.empty()) text = file + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
  text += what;
  if (!advice.empty()) text += "; " + advice;
  return printable(text);
}

}  // namespace

std::string excerpt(std::string_view text, std::size_t maxBytes) {
  std::size_t length = std::min(text.size(), maxBytes);
  const auto continues = [](char byte) { return (static_cast<unsigned char>(byte) & 0xC0) == 0x80; };
  while (length > 0 && length < text.size() && continues(text[length])) --length;  // whole characters of UTF-8
  const std::string cut = printable(text.substr(0, length));
  return length < text.size() ? cut + "..." : cut;
}

InputError::InputError(const std::string& what, const std::string& advice) : InputError({}, 0, what, advice) {}

InputError::InputError(const std::string& file, int line, const std::string& what, const std::string& advice)
    : std::runtime_error(message(file, line, what, advice)), file_(file), line_(line), advice_(advice) {}

}  // namespace hemitex::raster
