// Matrices in SciPy's files.
#include "reference/matrices/matrix_files.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("F.npz");
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] { reference::readMatrix(path); });
}
