// The file vector.json of a test vector, beside arrays of one from the suite.
#include "reference/conformance/suite/vector_suite.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

namespace {

/// Beside the arrays that the seeds name.
struct VectorFile : fuzz::InputFile {
  VectorFile() : InputFile("vector.json") { reference::writeVector(folder(), reference::texelVectors().front(), {}); }
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const VectorFile file;
  file.write(data, size);
  return fuzz::ignoringInputErrors([&] { reference::readVector(file.folder()); });
}
