// calibrate finds the profiles of simulated devices with random errors within these profiles.
#include "reference/conformance/calibration/calibration.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/verdict/verdict.h"
#include "tests/support/injected_faults.h"

using namespace hemitex;
using reference::Calibration;
using reference::Coverage;
using reference::DepthFormat;
using reference::DeviceProfile;
using reference::EdgeRule;
using reference::PixelVerdict;
using reference::SnapRounding;
using tests::Interpolation;
using tests::SimulatedDevice;

namespace {

std::vector<raster::ItemBuffer> drawProbes(const SimulatedDevice& device, const reference::ProbingSet& probes) {
  std::vector<raster::ItemBuffer> answers;
  for (const reference::TestVector& vector : vectorsOf(probes))
    answers.push_back(drawOn(device, vector.list, vector.faces.front().face));
  return answers;
}

std::vector<raster::ItemBuffer> drawByRules(const reference::ProbingSet& probes) {
  std::vector<raster::ItemBuffer> answers;
  for (const reference::TestVector& vector : vectorsOf(probes)) answers.push_back(reference::render(vector).front());
  return answers;
}

void reverseRows(raster::ItemBuffer& buffer) {
  for (auto row = buffer.ids.begin(), last = buffer.ids.end() - buffer.width; row < last;
       row += buffer.width, last -= buffer.width)
    std::swap_ranges(row, row + buffer.width, last);
}

/// Devices of all snappings, both edge rules, texel precisions from coarse to exact, and all depth formats.
std::vector<SimulatedDevice> devices() {
  std::vector<SimulatedDevice> devices;
  for (int bits = 4; bits <= 12; ++bits)
    for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate}) {
      const int number = static_cast<int>(devices.size());
      SimulatedDevice device;
      device.profile.subpixelBits = bits;
      device.profile.snapRounding = rounding;
      // The steps share no factor with the counts of their ranges, and differ from each other.
      device.profile.texelPrecision = std::ldexp(1 + number % 4 / 4.0, -4 - number * 5 % 13);
      constexpr DepthFormat formats[] = {DepthFormat::Float32, DepthFormat::Unorm24, DepthFormat::Unorm16};
      device.profile.depthFormat = formats[(number + number / 6) % 3];
      device.bottomRight = number % 4 >= 2;
      if (device.bottomRight) device.profile.edgeRule = EdgeRule::Any;
      device.seed = static_cast<std::uint32_t>(number);
      devices.push_back(device);
    }
  return devices;
}

/// Draws the vectors. Pixels that the default profile explains are explained by `profile`, too, and no pixel is an
/// error. Returns the number of explained pixels.
std::uint64_t checkVectors(const SimulatedDevice& device, const std::vector<reference::TestVector>& vectors,
                           const DeviceProfile& profile) {
  std::uint64_t explained = 0;
  for (const reference::TestVector& vector : vectors) {
    INFO(vector.name);
    const tests::Buffers found = drawAll(device, vector);
    const reference::Verdict calibrated = judge(vector, found, profile), usual = judge(vector, found, {});
    std::uint64_t errors = 0, worse = 0;
    for (std::size_t f = 0; f < calibrated.faces.size(); ++f)
      for (std::size_t p = 0; p < calibrated.faces[f].pixels.size(); ++p) {
        const bool isError = calibrated.faces[f].pixels[p] == PixelVerdict::Error;
        errors += isError;
        worse += isError && usual.faces[f].pixels[p] != PixelVerdict::Error;
        explained += !isError && calibrated.faces[f].pixels[p] != PixelVerdict::Exact;
      }
    CHECK(errors == 0);
    CHECK(worse == 0);
  }
  return explained;
}

std::uint64_t errorsOf(const SimulatedDevice& device, const std::vector<reference::TestVector>& vectors,
                       const DeviceProfile& profile) {
  std::uint64_t errors = 0;
  for (const reference::TestVector& vector : vectors)
    errors +=
        countVerdicts(judge(vector, drawAll(device, vector), profile))[static_cast<std::size_t>(PixelVerdict::Error)];
  return errors;
}

}  // namespace

TEST_CASE("coverageOf differs for any two snappings on some probe, for both edge rules", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const auto sureAnswers = [&](int bits, SnapRounding rounding) {
    std::vector<Coverage> coverage;
    for (const auto& sheet : probes.coverage)
      for (const reference::CoverageProbe& probe : sheet.pixels) coverage.push_back(coverageOf(probe, bits, rounding));
    return coverage;
  };
  std::vector<std::vector<Coverage>> answers;
  for (int bits = 4; bits <= 12; ++bits)
    for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate})
      answers.push_back(sureAnswers(bits, rounding));
  std::size_t fewest = answers[0].size();
  for (std::size_t a = 0; a < answers.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      std::size_t different = 0;
      for (std::size_t k = 0; k < answers[a].size(); ++k)
        different += (answers[a][k] == Coverage::Inside && answers[b][k] == Coverage::Outside) ||
                     (answers[a][k] == Coverage::Outside && answers[b][k] == Coverage::Inside);
      fewest = std::min(fewest, different);
    }
  CHECK(fewest > 20);
}

TEST_CASE("makeProbes gives the same probes on all machines", "[calibration]") {
  // Answers drawn with one build's probes may be read by another build.
  std::vector<raster::ItemId> bits;
  for (const reference::TestVector& vector : vectorsOf(reference::makeProbes())) {
    for (const glm::vec3& position : vector.list.positions)
      for (int k = 0; k < 3; ++k) bits.push_back(std::bit_cast<raster::ItemId>(position[k]));
    for (const glm::vec2& texcoord : vector.list.texcoords)
      for (int k = 0; k < 2; ++k) bits.push_back(std::bit_cast<raster::ItemId>(texcoord[k]));
  }
  CHECK(reference::idsHash(bits) == "39be11ede5a707a4");
}

TEST_CASE("calibrate finds the rules of the reference renderer", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const Calibration calibration = calibrate(probes, drawByRules(probes));
  CHECK(calibration.faults.empty());
  CHECK(calibration.profile.subpixelBits == 8);
  CHECK(calibration.profile.snapRounding == SnapRounding::Nearest);
  CHECK(calibration.profile.edgeRule == EdgeRule::TopLeft);
  CHECK(calibration.profile.texelPrecision == 0);
  CHECK(calibration.profile.interpolationError == 0);
  CHECK(calibration.profile.depthFormat == DepthFormat::Float32);
}

TEST_CASE("calibrate finds the profile of a device from its answers", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  for (const SimulatedDevice& device : devices()) {
    const Calibration calibration = calibrate(probes, drawProbes(device, probes));
    const DeviceProfile &is = device.profile, &found = calibration.profile;
    INFO(is.subpixelBits << " bits, device " << device.seed << ", texel precision " << is.texelPrecision);
    for (const std::string& fault : calibration.faults) FAIL_CHECK(fault);
    CHECK(found.subpixelBits == is.subpixelBits);
    CHECK(found.snapRounding == is.snapRounding);
    CHECK(found.edgeRule == is.edgeRule);
    CHECK(found.depthFormat == is.depthFormat);
    CHECK(found.texelPrecision >= is.texelPrecision);
    CHECK(found.texelPrecision <= 2 * is.texelPrecision);
  }
}

TEST_CASE("judge with the calibrated profile finds no errors in any vector of the suite", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const std::vector<reference::TestVector> suite = reference::wholeSuite(HEMITEX_DATA);
  const std::vector<SimulatedDevice> all = devices();
  std::uint64_t explained = 0;
  for (const std::size_t number : {0, 5, 10, 17}) {
    const DeviceProfile profile = calibrate(probes, drawProbes(all[number], probes)).profile;
    INFO("device " << number);
    explained += checkVectors(all[number], suite, profile);
  }
  // Makes sure that the devices have errors that need the profile.
  CHECK(explained > 1000);
}

TEST_CASE("calibrate measures interpolation in binary32, so that its profile explains what the default one does",
          "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  std::vector<reference::TestVector> vectors = reference::vectorSuite();
  for (std::uint64_t index = 0; index < 500; ++index) vectors.push_back(reference::interleavedRandomVector(0, index));
  for (const auto& [bits, interpolation, vertexError] :
       {std::tuple(4, Interpolation::Planes32, 0.0), std::tuple(8, Interpolation::Planes32, 8.0),
        std::tuple(4, Interpolation::Barycentric32, 8.0), std::tuple(8, Interpolation::Barycentric32, 0.0)}) {
    SimulatedDevice device;
    device.profile.subpixelBits = bits;
    device.profile.vertexError = vertexError;
    device.profile.texelPrecision = 0;
    device.interpolation = interpolation;
    INFO(bits << " bits, interpolation " << static_cast<int>(interpolation) << ", vertex error " << vertexError);
    const Calibration calibration = calibrate(probes, drawProbes(device, probes));
    CHECK(calibration.faults.empty());
    CHECK(calibration.profile.subpixelBits == bits);
    CHECK(calibration.profile.texelPrecision < 0x1p-14);
    CHECK(calibration.profile.interpolationError > 4);
    CHECK(calibration.profile.interpolationError < 32);
    CHECK(checkVectors(device, vectors, calibration.profile) > 1000);
  }
}

TEST_CASE("judge has more errors with a profile without interpolation error than with the default one",
          "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const std::vector<reference::TestVector> suite = reference::vectorSuite();
  SimulatedDevice device;
  device.profile = {.subpixelBits = 4, .texelPrecision = 0};
  device.interpolation = Interpolation::Planes32;
  DeviceProfile profile = calibrate(probes, drawProbes(device, probes)).profile;
  CHECK(errorsOf(device, suite, profile) == 0);
  profile.interpolationError = 0;
  CHECK(errorsOf(device, suite, profile) > errorsOf(device, suite, {}));
}

TEST_CASE("calibrate finds an interpolation error of at least that of a device, and at most four times as large",
          "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  for (const double roundings : {1.0, 5.0, 20.0, 60.0}) {
    SimulatedDevice device;
    device.profile.texelPrecision = 0;
    device.profile.vertexError = 0;
    device.profile.interpolationError = roundings;
    const DeviceProfile found = calibrate(probes, drawProbes(device, probes)).profile;
    CHECK(found.interpolationError >= roundings);
    CHECK(found.interpolationError <= 4 * roundings);
    CHECK(found.texelPrecision <= 0x1p-14);
  }
}

TEST_CASE("calibrate finds only the depth format for a device that only rounds depths", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  for (const DepthFormat format : {DepthFormat::Float32, DepthFormat::Unorm24, DepthFormat::Unorm16}) {
    SimulatedDevice device;
    device.profile.vertexError = 0;
    device.profile.texelPrecision = 0;
    device.profile.depthTolerance = 0.5;
    device.profile.depthFormat = format;
    const Calibration calibration = calibrate(probes, drawProbes(device, probes));
    CHECK(calibration.faults.empty());
    CHECK(calibration.profile.depthFormat == format);
    CHECK(calibration.profile.texelPrecision == 0);
  }
}

TEST_CASE("calibrate reports answers that no profile explains", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const auto faultsOf = [&](const std::vector<raster::ItemBuffer>& answers) {
    std::string faults;
    for (const std::string& fault : calibrate(probes, answers).faults) faults += fault.substr(0, fault.find(':')) + " ";
    return faults;
  };
  const std::size_t depths = probes.coverage.size() + probes.texels.size() + probes.interpolation.size();
  const std::vector<raster::ItemBuffer> right = drawByRules(probes);
  CHECK(faultsOf(right) == "");
  CHECK(faultsOf(drawProbes({.profile = {}, .shift = 1}, probes)) == "coverage ");
  CHECK(faultsOf(drawProbes({.profile = {}, .texelShift = 0.5}, probes)) == "texels ");
  // A sample that a triangle covers far from any edge is missing, an unknown item ID, and a wrong depth test.
  std::vector<raster::ItemBuffer> hole = right;
  for (std::size_t pixel = 0; pixel < 256; ++pixel) {
    const reference::CoverageProbe& probe = probes.coverage[0].pixels[pixel];
    bool isInside = true;
    for (int bits = 4; bits <= 12; ++bits)
      for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate})
        isInside &= coverageOf(probe, bits, rounding) == Coverage::Inside;
    if (!isInside) continue;
    hole[0].ids[pixel] = 0xffffffff;
    break;
  }
  CHECK(faultsOf(hole) == "coverage ");
  std::vector<raster::ItemBuffer> stranger = right;
  stranger[probes.coverage.size()].ids[77] += 2;
  CHECK(faultsOf(stranger) == "texels ");
  std::vector<raster::ItemBuffer> lastWins = right;
  std::fill(lastWins[depths].ids.begin(), lastWins[depths].ids.end(), 2u);
  CHECK(faultsOf(lastWins) == "depth ");
}

TEST_CASE("calibrate names reversed rows instead of another edge rule", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const auto answersOf = [&](const SimulatedDevice& device, bool isUpsideDown, bool isReversed) {
    std::vector<raster::ItemBuffer> answers;
    for (const reference::TestVector& vector : vectorsOf(probes)) {
      raster::Face face = vector.faces.front().face;
      if (isUpsideDown) face.y = -face.y;
      raster::ItemBuffer& buffer = answers.emplace_back(drawOn(device, vector.list, face));
      if (isReversed) reverseRows(buffer);
    }
    return answers;
  };
  for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate}) {
    SimulatedDevice device;
    device.profile.snapRounding = rounding;
    const auto faultsOf = [&](bool isUpsideDown, bool isReversed) {
      return calibrate(probes, answersOf(device, isUpsideDown, isReversed)).faults;
    };
    const auto isOnly = [](const std::vector<std::string>& faults, const std::string& part) {
      return faults.size() == 1 && faults[0].find(part) != std::string::npos;
    };
    // The right picture, but its samples on edges belong to bottom edges.
    CHECK(isOnly(faultsOf(true, true), "bottom edges"));
    CHECK(isOnly(faultsOf(true, false), "the picture is upside down"));
    CHECK(isOnly(faultsOf(false, true), "the rows are in reverse order"));
  }
}
