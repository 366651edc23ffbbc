// Device profiles: all that parseProfile accepts is written and read back equal.
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "reference/conformance/verdict/device_profile.h"
#include "tests/fuzz/fuzz_input.h"

using namespace hemitex;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return fuzz::ignoringInputErrors([&] {
    const reference::DeviceProfile profile = reference::parseProfile(fuzz::textOf(data, size));
    if (reference::parseProfile(reference::toJson(profile).dump()) != profile)
      throw std::logic_error("reads back otherwise");
  });
}
