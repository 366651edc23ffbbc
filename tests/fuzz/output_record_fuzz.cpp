// Records of the files that hemitex wrote into a folder, which an even first byte gives to solution.json and an odd one
// to .hemitex.json. The text of a record is read back as the same.
#include <array>
#include <stdexcept>

#include "cli/common/output_record.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::array<fuzz::InputFile, 2> files{fuzz::InputFile(cli::solutionName),
                                                    fuzz::InputFile(cli::recordName)};
  static const fuzz::InputFile written(cli::recordName);
  if (size == 0) return 0;
  const fuzz::InputFile& file = files[data[0] % files.size()];
  file.write(data + 1, size - 1);
  return fuzz::ignoringInputErrors([&] {
    const std::string text = cli::OutputRecord(cli::Folder(file.folder())).text();
    written.write(reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
    if (cli::OutputRecord(cli::Folder(written.folder())).text() != text) throw std::logic_error("reads back otherwise");
  });
}
