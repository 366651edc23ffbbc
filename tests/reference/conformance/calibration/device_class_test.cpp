// guessDeviceClass names the properties of simulated devices, and nothing for devices with faults.
#include "reference/conformance/calibration/device_class.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/suite/vector_suite.h"
#include "tests/support/injected_faults.h"

using namespace hemitex;
using reference::DepthFormat;
using reference::DeviceClass;
using reference::SnapRounding;
using tests::SimulatedDevice;

namespace {

std::optional<DeviceClass> guessFrom(const std::vector<reference::TestVector>& vectors,
                                     const std::vector<tests::Buffers>& found) {
  std::vector<reference::Verdict> verdicts;
  for (std::size_t k = 0; k < vectors.size(); ++k) verdicts.push_back(judge(vectors[k], found[k], {}));
  std::vector<reference::JudgedVector> judged;
  for (std::size_t k = 0; k < vectors.size(); ++k) judged.push_back({&vectors[k], &verdicts[k]});
  return guessDeviceClass(judged);
}

std::optional<DeviceClass> guessFor(const SimulatedDevice& device, const std::vector<reference::TestVector>& vectors) {
  std::vector<tests::Buffers> found;
  for (const reference::TestVector& vector : vectors) found.push_back(drawAll(device, vector));
  return guessFrom(vectors, found);
}

}  // namespace

TEST_CASE("guessDeviceClass names the property in which a device differs from the default profile", "[calibration]") {
  const std::vector<reference::TestVector> suite = reference::vectorSuite();
  const auto deviceOf = [](const reference::DeviceProfile& profile) { return SimulatedDevice{.profile = profile}; };
  SimulatedDevice plain = deviceOf({.subpixelBits = 4, .texelPrecision = 0});
  plain.interpolation = tests::Interpolation::Planes32;
  SimulatedDevice bottomRight;
  bottomRight.bottomRight = true;
  const std::vector<std::pair<std::string, SimulatedDevice>> devices{
      {"4 sub-pixel bits", plain},
      {"5 sub-pixel bits", deviceOf({.subpixelBits = 5})},
      {"6 sub-pixel bits, truncated", deviceOf({.subpixelBits = 6, .snapRounding = SnapRounding::Truncate})},
      {"16-bit depths", deviceOf({.depthFormat = DepthFormat::Unorm16})},
      {"texture coordinates of 6 sub-texel bits", deviceOf({.texelPrecision = 1.0 / 64})},
      {"another edge rule, or rows that are reversed on readback", bottomRight}};
  for (const auto& [properties, device] : devices) {
    INFO(properties);
    const std::optional<DeviceClass> guess = guessFor(device, suite);
    REQUIRE(guess);
    CHECK(guess->properties == properties);
    CHECK(guess->explained == guess->errors);
    CHECK(guess->errors > 50);
    CHECK(toText(*guess) == std::to_string(guess->errors) + " of " + std::to_string(guess->errors) +
                                " errors fit a device with " + properties);
  }
}

TEST_CASE("guessDeviceClass names several properties", "[calibration]") {
  SimulatedDevice device;
  device.profile.subpixelBits = 5;
  device.profile.depthFormat = DepthFormat::Unorm16;
  const std::optional<DeviceClass> guess = guessFor(device, reference::vectorSuite());
  REQUIRE(guess);
  CHECK(guess->profile.subpixelBits <= 5);
  CHECK(guess->profile.depthFormat == DepthFormat::Unorm16);
  CHECK(guess->properties.find(" and 16-bit depths") != std::string::npos);
}

TEST_CASE("guessDeviceClass names no sub-pixel bits for corners that are moved anywhere", "[calibration]") {
  SimulatedDevice sloppy;
  sloppy.vertex = [](raster::ViewVertex& v) {
    const double place = 1e7 * v.x;
    v.x += (place - std::floor(place) - 0.5) / 200 * v.w;
  };
  const std::vector<reference::TestVector> suite = reference::vectorSuite();
  for (const SimulatedDevice& device : {sloppy, SimulatedDevice{.profile = {}, .shift = 3}}) {
    const std::optional<DeviceClass> guess = guessFor(device, suite);
    CHECK((!guess || guess->properties.find("sub-pixel bits") == std::string::npos));
  }
}

TEST_CASE("guessDeviceClass gives nothing for a device without errors, or with a fault that is no property of a class",
          "[calibration]") {
  const std::vector<reference::TestVector> suite = reference::wholeSuite(HEMITEX_DATA);
  CHECK_FALSE(guessFor({}, {suite[0], suite[1]}));
  // Three faults are properties of a class, but no class has samples on edges that no triangle covers.
  const std::set<std::string> properties{"wrong fill rule", "16-bit depth", "vertices snapped to fewer bits"};
  for (const tests::Injection& injection : tests::injectedFaults()) {
    INFO(injection.fault << " on " << injection.vector);
    const auto vector = std::find_if(suite.begin(), suite.end(),
                                     [&](const reference::TestVector& v) { return v.name == injection.vector; });
    REQUIRE(vector != suite.end());
    const std::optional<DeviceClass> guess = guessFrom({*vector}, {injection.draw(*vector, {})});
    const bool isImpossible = injection.fault == "wrong fill rule" && injection.vector == "borders-on-samples";
    CHECK(guess.has_value() == (properties.contains(injection.fault) && !isImpossible));
  }
}
