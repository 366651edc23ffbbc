// Files of expected results.
#include <array>

#include "reference/conformance/verdict/expectations.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("expected.txt");
  static const std::array<std::string, 3> vectors = {"five-faces", "same-triangle", "a"};
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] { reference::readExpectations(path, vectors); });
}
