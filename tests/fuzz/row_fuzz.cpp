// Rows of a matrix that are kept for a later run: the number of the row, and its text. The hash of both is made here.
// All that numberedRow accepts is written, and read back as the same text.
#include <stdexcept>

#include "cli/formfactors/row_file.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

namespace {

constexpr std::size_t receivers = 3;

std::optional<reference::SparseRow> read(std::size_t number, const std::string& text) {
  std::string line = cli::numberedLine(number, text);
  line.pop_back();
  return cli::numberedRow(line, number, receivers);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::size_t number = data[0] % 4;
  const auto row = read(number, fuzz::textOf(data + 1, size - 1));
  fuzz::countOutcome(row ? "a row" : "none");
  if (!row) return 0;
  const std::string text = cli::lineOf(*row);
  const auto again = read(number, text);
  if (!again || cli::lineOf(*again) != text) throw std::logic_error("reads back otherwise");
  return 0;
}
