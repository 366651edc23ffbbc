// Stored solutions: all that takeSnapshot accepts is written with the bytes that were read.
#include <stdexcept>
#include <string_view>

#include "radiosity/solver/snapshot.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::ignoringInputErrors([&] {
    const std::string text = fuzz::textOf(data, size);
    std::string_view rest = text;
    const std::string written = radiosity::toBytes(radiosity::takeSnapshot(rest));
    if (written != text.substr(0, text.size() - rest.size())) throw std::logic_error("writes other bytes");
  });
}
