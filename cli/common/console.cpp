#include "cli/common/console.h"

#include <unistd.h>

#include <algorithm>
#include <boost/algorithm/string.hpp>
#include <iostream>

#include "raster/base/printable_text.h"

namespace hemitex::cli {
namespace {

constexpr int barLength = 30;
constexpr std::size_t maxLine = 1000;
constexpr std::size_t blockBytes = 1 << 16;
constexpr std::chrono::milliseconds barInterval{100};
constexpr std::chrono::seconds lineInterval{10};

}  // namespace

std::string shortened(const std::string& text, std::size_t maxBytes) {
  if (text.size() <= maxBytes) return text;
  const std::size_t tail = maxBytes / 3;
  return text.substr(0, maxBytes - tail) + " ... " + text.substr(text.size() - tail);
}

std::string shellQuoted(const std::string& text) { return '\'' + boost::replace_all_copy(text, "'", "'\\''") + '\''; }

void Console::error(const std::string& text, const std::string& advice) {
  print("hemitex: error: " + text);
  if (!advice.empty()) print(advice);
}

void Console::warning(const std::string& text) {
  given_.push_back(text);
  if (verbosity != Verbosity::Quiet) print("hemitex: warning: " + text);
}

void Console::warnings(const std::vector<std::string>& texts) {
  for (const std::string& text : texts) warning(text);
}

void Console::message(const std::string& text) {
  if (verbosity != Verbosity::Quiet) print("hemitex: " + text);
}

void Console::detail(const std::string& text) {
  if (verbosity == Verbosity::Verbose) print("hemitex: " + text);
}

void Console::progress(double fraction, const std::string& text) {
  if (verbosity == Verbosity::Quiet) return;
  const auto now = std::chrono::steady_clock::now();
  if (isatty(STDERR_FILENO) == 0) {
    if (now - shown_ < lineInterval) return;
    detail(text);
    shown_ = now;
    return;
  }
  if (barShown_ && now - shown_ < barInterval) return;
  const int filled = static_cast<int>(std::clamp(fraction, 0.0, 1.0) * barLength);
  const std::string bar = std::string(static_cast<std::size_t>(filled), '#') +
                          std::string(static_cast<std::size_t>(barLength - filled), '.');
  std::cerr << "\r\033[K[" << bar << "] " << raster::printable(text) << std::flush;
  shown_ = now;
  barShown_ = true;
}

void Console::machineLine(const std::string& text) {
  endProgress();
  std::cerr << raster::printable(text) << std::endl;
}

void Console::endProgress() {
  if (barShown_) std::cerr << "\r\033[K" << std::flush;
  barShown_ = false;
}

void Console::print(const std::string& line) {
  endProgress();
  std::cerr << raster::printable(shortened(line, maxLine)) << '\n';
}

PrintableStream::PrintableStream(std::ostream& stream) : stream_(stream), target_(stream.rdbuf(this)) {}

PrintableStream::~PrintableStream() {
  write(text_.size());
  stream_.rdbuf(target_);
}

std::streamsize PrintableStream::xsputn(const char* text, std::streamsize size) {
  text_.append(text, static_cast<std::size_t>(size));
  if (text_.size() < blockBytes) return size;
  const std::size_t lineEnd = text_.rfind('\n');
  return write(lineEnd == std::string::npos ? text_.size() : lineEnd + 1) ? size : 0;
}

PrintableStream::int_type PrintableStream::overflow(int_type character) {
  const char byte = traits_type::to_char_type(character);
  return xsputn(&byte, 1) == 1 ? character : traits_type::eof();
}

int PrintableStream::sync() { return write(text_.size()) ? target_->pubsync() : -1; }

/// Writes the first bytes of the text, up to the end of a line or of the text.
bool PrintableStream::write(std::size_t size) {
  const std::string part = raster::printable(std::string_view(text_).substr(0, size), "\n\t");
  text_.erase(0, size);
  return target_->sputn(part.data(), static_cast<std::streamsize>(part.size())) ==
         static_cast<std::streamsize>(part.size());
}

}  // namespace hemitex::cli
