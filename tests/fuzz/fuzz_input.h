/// What the harnesses of this folder share. A harness gives bytes to a function of the library. It may throw
/// InputError; anything else that leaves it is a finding, as is a message of a sanitizer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "tests/support/temporary_folder.h"

/// The function that libFuzzer calls.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace hemitex::fuzz {

inline std::string textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

/// A file in a folder of its own, for functions that read files. Each input replaces its content. Use a TMPDIR in
/// memory: disks take a millisecond per input.
class InputFile {
 public:
  explicit InputFile(const std::string& name) : path_(folder_.path / name) {}

  const std::filesystem::path& write(const std::uint8_t* data, std::size_t size) const {
    std::ofstream(path_, std::ios::binary) << textOf(data, size);
    return path_;
  }
  const std::filesystem::path& folder() const { return folder_.path; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path path_;
};

/// Counters that libFuzzer reads after each input, and clears. It keeps an input that raises a new one, as one that
/// reaches new code: so it also looks for new messages in libraries whose code it does not observe.
__attribute__((section("__libfuzzer_extra_counters"))) static std::uint8_t outcomes[512];

/// Counts an outcome, such as a message: whatever its numbers, and what it quotes.
inline void countOutcome(std::string outcome) {
  const std::size_t quote = outcome.find('\'');
  if (quote != outcome.npos) outcome.erase(quote, outcome.rfind('\'') - quote);
  std::erase_if(outcome, [](char c) { return c >= '0' && c <= '9'; });
  ++outcomes[std::hash<std::string>{}(outcome) % sizeof(outcomes)];
}

/// Calls `read` with one thread, and ignores the faults that it reports. With more threads, the same input would take
/// other ways, and libFuzzer would keep it again.
template <typename Read>
int ignoringInputErrors(const Read& read) {
  static const raster::ThreadLimit one(1);
  try {
    read();
    countOutcome({});
  } catch (const raster::InputError& error) {
    countOutcome(std::string(error.what()).substr(error.file().size()));
  }
  return 0;
}

}  // namespace hemitex::fuzz
