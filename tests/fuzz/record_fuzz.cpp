// Conformance records: what readRecord returns can be written again.
#include "reference/conformance/records/conformance_record.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const fuzz::InputFile file("record.json");
  const std::filesystem::path& path = file.write(data, size);
  return fuzz::ignoringInputErrors([&] { reference::toJson(reference::readRecord(path).record); });
}
