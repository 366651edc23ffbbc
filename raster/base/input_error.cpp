#include "raster/base/input_error.h"

namespace hemitex::raster {
namespace {

std::string message(const std::string& file, int line, const std::string& what, const std::string& advice) {
  std::string text;
  if (!file.empty()) text = file + (line > 0 ? ":" + std::to_string(line) : "") + ": ";
  text += what;
  if (!advice.empty()) text += "; " + advice;
  return text;
}

}  // namespace

InputError::InputError(const std::string& what, const std::string& advice) : InputError({}, 0, what, advice) {}

InputError::InputError(const std::string& file, int line, const std::string& what, const std::string& advice)
    : std::runtime_error(message(file, line, what, advice)), file_(file), line_(line), advice_(advice) {}

}  // namespace hemitex::raster
