// calibrate finds the profiles of simulated devices with random errors within these profiles.
#include "reference/calibration/calibration.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>

#include "reference/vectors/scene_vectors.h"
#include "reference/vectors/vector_suite.h"
#include "reference/verdict/verdict.h"
#include "tests/support/simulated_device.h"

using namespace hemitex;
using reference::Calibration;
using reference::Coverage;
using reference::DepthFormat;
using reference::DeviceProfile;
using reference::EdgeRule;
using reference::SnapRounding;
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

TEST_CASE("experiment", "[.exp]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const std::vector<reference::TestVector> suite = reference::wholeSuite(HEMITEX_DATA);
  for (const tests::Interpolation interpolation :
       {tests::Interpolation::Exact, tests::Interpolation::Barycentric32, tests::Interpolation::Planes32})
    for (const int bits : {4, 8})
      for (const double vertexError : {0.0, 8.0}) {
        SimulatedDevice device;
        device.profile.subpixelBits = bits;
        device.profile.vertexError = vertexError;
        device.profile.texelPrecision = 0;
        device.profile.depthTolerance = 1;
        device.interpolation = interpolation;
        const Calibration calibration = calibrate(probes, drawProbes(device, probes));
        std::printf("interp %d bits %d verr %g: bits %d p %g c %g faults %zu\n", (int)interpolation, bits, vertexError,
                    calibration.profile.subpixelBits, calibration.profile.texelPrecision,
                    calibration.profile.interpolationError, calibration.faults.size());
        for (int k = 0; k < 4; ++k) {
          DeviceProfile profile = calibration.profile;
          if (k == 0) profile = {};
          if (k == 2) profile.interpolationError = 0;
          if (k == 3) profile.interpolationError /= 4;
          std::uint64_t errors = 0, texel = 0;
          std::string names;
          for (const reference::TestVector& vector : suite) {
            std::vector<raster::ItemBuffer> found;
            for (const reference::VectorFace& face : vector.faces)
              found.push_back(drawOn(device, vector.list, face.face));
            const reference::VerdictCounts counts = countVerdicts(judge(vector, found, profile));
            errors += counts[5];
            texel += counts[2];
            if (counts[5]) names += vector.name + ":" + std::to_string(counts[5]) + " ";
          }
          std::printf("   %s errors %llu texel %llu %s\n",
                      k == 0   ? "default"
                      : k == 1 ? "calibrated"
                      : k == 2 ? "without c"
                               : "c/4",
                      (unsigned long long)errors, (unsigned long long)texel, k == 0 ? "" : names.c_str());
        }
      }
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
    const SimulatedDevice& device = all[number];
    const DeviceProfile profile = calibrate(probes, drawProbes(device, probes)).profile;
    for (const reference::TestVector& vector : suite) {
      std::vector<raster::ItemBuffer> found;
      for (const reference::VectorFace& face : vector.faces) found.push_back(drawOn(device, vector.list, face.face));
      const reference::VerdictCounts counts = countVerdicts(judge(vector, found, profile));
      INFO("device " << number << ", " << vector.name);
      CHECK(counts[static_cast<std::size_t>(reference::PixelVerdict::Error)] == 0);
      for (std::size_t k = 1; k < counts.size(); ++k) explained += counts[k];
    }
  }
  // Makes sure that the devices have errors that need the profile.
  CHECK(explained > 1000);
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
    CHECK(faultsOf(false, false).empty());
    // The right picture, but its samples on edges belong to bottom edges.
    REQUIRE(faultsOf(true, true).size() == 1);
    CHECK(faultsOf(true, true)[0].find("bottom edges") != std::string::npos);
    for (const bool isUpsideDown : {false, true}) {
      REQUIRE(faultsOf(isUpsideDown, !isUpsideDown).size() == 1);
      CHECK(faultsOf(isUpsideDown, !isUpsideDown)[0].find("the rows are in reverse order") != std::string::npos);
    }
  }
}
