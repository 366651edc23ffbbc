// Matrices in text and in View3D's files. The first byte says which format the others are in.
#include <array>

#include "reference/matrices/matrix_files.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const std::array<fuzz::InputFile, 4> files{fuzz::InputFile("F.mtx"), fuzz::InputFile("F.csv"),
                                                    fuzz::InputFile("F.txt"), fuzz::InputFile("F.vf")};
  if (size == 0) return 0;
  const std::filesystem::path& path = files[data[0] % files.size()].write(data + 1, size - 1);
  return fuzz::ignoringInputErrors([&] { reference::readMatrix(path); });
}
