// calibrate finds the profiles of simulated devices with random errors within these profiles.
#include "reference/conformance/calibration/calibration.h"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <optional>
#include <set>

#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/verdict/verdict.h"
#include "tests/support/injected_faults.h"
#include "tests/support/staged_drawing.h"

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

/// The answers of a device with another fill rule.
std::vector<raster::ItemBuffer> drawProbes(const SimulatedDevice& device,
                                           const std::function<bool(const raster::SnappedPoint&)>& ownsSamples,
                                           const reference::ProbingSet& probes) {
  reference::StagedDevice stages = stagedDeviceOf(device);
  stages.ownsSamples = ownsSamples;
  std::vector<raster::ItemBuffer> answers;
  for (const reference::TestVector& vector : vectorsOf(probes))
    answers.push_back(tests::drawAll(stages, vector).front());
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
  for (int bits = 4; bits <= 16; ++bits)
    for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate}) {
      const int number = static_cast<int>(devices.size());
      SimulatedDevice device;
      device.profile.subpixelBits = bits;
      device.profile.snapRounding = rounding;
      // Finer snapping is of use only with finer positions.
      if (bits > 12) device.profile.vertexError = 1;
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

/// A device that errs in nothing but what a test lets it do.
SimulatedDevice exactDevice(int bits = 8, SnapRounding rounding = SnapRounding::Nearest) {
  SimulatedDevice device;
  device.profile.vertexError = 0;
  device.profile.texelPrecision = 0;
  device.profile.depthTolerance = 0.5;
  device.profile.subpixelBits = bits;
  device.profile.snapRounding = rounding;
  return device;
}

/// Multiplies u and v by N and M in binary32, as the OpenGL stack of an H200 did without being asked.
SimulatedDevice deviceWithRoundedProducts() {
  SimulatedDevice device = exactDevice();
  device.fetch = [](const raster::IndexMap& map, const glm::dvec2& at) {
    return reference::texelAt(map, glm::dvec2(glm::vec2(at)));
  };
  return device;
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
  struct Snapping {
    int bits;
    SnapRounding rounding;
  };
  std::vector<Snapping> snappings{{reference::exactBits, SnapRounding::None}};
  for (int bits = 4; bits <= 16; ++bits)
    for (const SnapRounding rounding : {SnapRounding::Nearest, SnapRounding::Truncate})
      snappings.push_back({bits, rounding});
  // On the probes of the one that is assumed.
  const auto contradictionsOf = [&](const Snapping& is, const Snapping& assumed) {
    std::size_t different = 0;
    for (const auto& sheet : probes.coverage)
      for (const reference::CoverageProbe& probe : sheet.pixels) {
        if (!probe.bits.contains(assumed.bits)) continue;
        const Coverage a = coverageOf(probe, is.bits, is.rounding),
                       b = coverageOf(probe, assumed.bits, assumed.rounding);
        different +=
            (a == Coverage::Inside && b == Coverage::Outside) || (a == Coverage::Outside && b == Coverage::Inside);
      }
    return different;
  };
  std::size_t fewest = 1000, fewestOfFine = 1000;
  for (const Snapping& is : snappings)
    for (const Snapping& assumed : snappings) {
      if (is.bits == assumed.bits && is.rounding == assumed.rounding) continue;
      std::size_t& least = assumed.bits <= 12 ? fewest : fewestOfFine;
      least = std::min(least, contradictionsOf(is, assumed));
    }
  CHECK(fewest > 20);
  CHECK(fewestOfFine > 8);
}

TEST_CASE("makeProbes gives the same probes on all machines", "[calibration]") {
  // Answers drawn with one build's probes may be read by another build. The second hash is of the probes that were
  // added later.
  std::vector<raster::ItemId> bits, added;
  for (const reference::TestVector& vector : vectorsOf(reference::makeProbes())) {
    if (vector.name.starts_with("clipping-")) continue;  // of the suite, which has hashes of its own
    const std::set<std::string> later{"snapping-13",  "snapping-14",       "snapping-15",        "snapping-16",
                                      "shared-edges", "shared-edges-fine", "shared-edges-exact", "texels-1000"};
    std::vector<raster::ItemId>& target = later.contains(vector.name) ? added : bits;
    for (const glm::vec3& position : vector.list.positions)
      for (int k = 0; k < 3; ++k) target.push_back(std::bit_cast<raster::ItemId>(position[k]));
    for (const glm::vec2& texcoord : vector.list.texcoords)
      for (int k = 0; k < 2; ++k) target.push_back(std::bit_cast<raster::ItemId>(texcoord[k]));
  }
  CHECK(reference::idsHash(bits) == "39be11ede5a707a4");
  CHECK(reference::idsHash(added) == "6f1a1384eaf74082");
}

TEST_CASE("snappingFits has no contradiction for the snapping of a device alone", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  SimulatedDevice device;
  device.profile.subpixelBits = 6;
  const std::vector<raster::ItemBuffer> answers = drawProbes(device, probes);
  int free = 0;
  for (const reference::SnappingFit& fit : snappingFits(probes, answers)) {
    CHECK(fit.probes > 100);
    free += fit.contradictions == 0;
    if (fit.contradictions == 0) CHECK((fit.bits == 6 && fit.rounding == SnapRounding::Nearest));
  }
  CHECK(free == 1);
}

TEST_CASE("makeProbes has probes of clipping that devices with other planes answer differently", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  CHECK(probes.clipping.size() == 2);
  int different = 0;
  for (const reference::TestVector& vector : probes.clipping) {
    CHECK(vector.faces.size() == 1);
    SimulatedDevice device;
    device.cutsAtView = true;
    const std::vector<raster::ItemId> found = tests::drawAll(device, vector)[0].ids;
    const std::vector<raster::ItemId> right = reference::render(vector)[0].ids;
    for (std::size_t p = 0; p < right.size(); ++p) different += found[p] != right[p];
  }
  CHECK(different > 0);
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
    // Snapping with more bits moves the corners of the probes less, and their coordinates by up to 1/1000 of a texel.
    CHECK(found.texelPrecision <= 2 * is.texelPrecision + (is.subpixelBits > 12 ? 0x1p-9 : 0));
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

TEST_CASE("calibrate measures a product u N in binary32 as roundings, so that its device passes", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const std::vector<reference::TestVector> suite = reference::vectorSuite();
  const SimulatedDevice device = deviceWithRoundedProducts();
  const Calibration calibration = calibrate(probes, drawProbes(device, probes));
  CHECK(calibration.faults.empty());
  CHECK(calibration.profile.texelPrecision == 0);
  CHECK(calibration.profile.interpolationError >= 1);
  CHECK(calibration.profile.interpolationError <= 4);
  CHECK(errorsOf(device, suite, calibration.profile) == 0);
  DeviceProfile without = calibration.profile;
  without.interpolationError = 0;
  CHECK(errorsOf(device, suite, without) > 1000);
}

TEST_CASE("calibrate finds that a device does not snap, and its profile explains its pixels", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const SimulatedDevice device = exactDevice(16, SnapRounding::None);
  const Calibration calibration = calibrate(probes, drawProbes(device, probes));
  CHECK(calibration.faults.empty());
  CHECK(calibration.profile.snapRounding == SnapRounding::None);
  CHECK(calibration.profile.edgeRule == EdgeRule::TopLeft);
  std::vector<reference::TestVector> suite = reference::vectorSuite();
  // The simulated device has no room for fine corners of so large a picture.
  std::erase_if(suite, [](const reference::TestVector& vector) { return vector.name == "corners-of-4096"; });
  CHECK(errorsOf(device, suite, calibration.profile) == 0);
}

TEST_CASE("calibrate allows only edge rules that give a sample on a shared edge to exactly one triangle",
          "[calibration]") {
  using raster::SnappedPoint;
  const reference::ProbingSet probes = reference::makeProbes();
  const auto calibrated = [&](int bits, const std::function<bool(const SnappedPoint&)>& ownsSamples) {
    const SnapRounding rounding = bits == reference::exactBits ? SnapRounding::None : SnapRounding::Nearest;
    return calibrate(probes, drawProbes(exactDevice(bits, rounding), ownsSamples, probes));
  };
  const auto faultOf = [](const Calibration& calibration) {
    return calibration.faults.size() == 1 ? calibration.faults[0] : "";
  };
  for (const int bits : {8, 12, 16, reference::exactBits}) {
    INFO(bits << " bits");
    CHECK(calibrated(bits, raster::ownsSamples).faults.empty());
    CHECK(calibrated(bits, raster::ownsSamples).profile.edgeRule == EdgeRule::TopLeft);
    // Diagonal from the upper right: a half plane of directions, as any consistent rule.
    const Calibration other =
        calibrated(bits, [](const SnappedPoint& d) { return d.x + 3 * d.y > 0 || (d.x + 3 * d.y == 0 && d.y > 0); });
    CHECK(other.faults.empty());
    CHECK(other.profile.edgeRule == EdgeRule::Any);
    CHECK(faultOf(calibrated(bits, [](const SnappedPoint&) { return true; })).find("in both triangles, at 32 of 32") !=
          std::string::npos);
    CHECK(faultOf(calibrated(bits, [](const SnappedPoint&) {
            return false;
          })).find("in neither triangle, at 32 of 32") != std::string::npos);
    // Only left edges: samples on horizontal edges are lost.
    CHECK(faultOf(calibrated(bits, [](const SnappedPoint& d) { return d.y < 0; })).find("in neither triangle") !=
          std::string::npos);
  }
}

TEST_CASE("calibrate names no snapping for a device whose corners are anywhere", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  SimulatedDevice device = exactDevice();
  device.vertex = [](raster::ViewVertex& v) {
    // The last bits decide, up to a sixteenth of a pixel.
    const double place = 1e7 * v.x;
    v.x += (place - std::floor(place) - 0.5) / 64 * v.w;
  };
  const Calibration calibration = calibrate(probes, drawProbes(device, probes));
  REQUIRE(!calibration.faults.empty());
  CHECK(calibration.faults[0].starts_with("coverage: no snapping from 4 to 16 bits explains all samples; each is"));
  CHECK(calibration.faults[0].find("truncated") == std::string::npos);
}

TEST_CASE("judge with the calibrated profile excuses fragments so far that they are stored as the cleared depth",
          "[calibration]") {
  // Strips of two columns at w = 2^12 n, 2^13 n, ... 2^27 n. Depths of 16 bits are lost from 2^17 n on, and those of
  // binary32 from 2^25 n on.
  reference::Picture picture(32, 0x1p-10f);
  for (int strip = 0; strip < 16; ++strip) {
    reference::addDraw(picture, static_cast<raster::ItemId>(strip));
    picture.addBlock({2 * strip, 0, 2 * strip + 2, 32}, std::ldexp(1.0, strip + 2));
  }
  const reference::TestVector vector = makeVector("far", "", picture);
  const reference::ProbingSet probes = reference::makeProbes();
  for (const DepthFormat format : {DepthFormat::Float32, DepthFormat::Unorm24, DepthFormat::Unorm16}) {
    SimulatedDevice device = exactDevice();
    device.profile.depthFormat = format;
    const Calibration calibration = calibrate(probes, drawProbes(device, probes));
    CHECK(calibration.faults.empty());
    CHECK(calibration.profile.depthFormat == format);
    const reference::Verdict verdict = judge(vector, drawAll(device, vector), calibration.profile);
    const reference::VerdictCounts counts = countVerdicts(verdict);
    CHECK(counts[static_cast<std::size_t>(PixelVerdict::Coverage)] > 20);
    CHECK(!hasErrors(verdict));
    // Nearer ones stay errors.
    tests::Buffers empty = drawAll(device, vector);
    empty[0].ids[1] = 0xffffffff;
    CHECK(hasErrors(judge(vector, empty, calibration.profile)));
  }
}

TEST_CASE("calibrate reports answers that no profile explains", "[calibration]") {
  const reference::ProbingSet probes = reference::makeProbes();
  const auto faultsOf = [&](const std::vector<raster::ItemBuffer>& answers) {
    std::string faults;
    for (const std::string& fault : calibrate(probes, answers).faults) faults += fault.substr(0, fault.find(':')) + " ";
    return faults;
  };
  const std::size_t texels = probes.coverage.size() + probes.sharedEdges.size();
  const std::size_t depths = texels + probes.texels.size() + probes.interpolation.size();
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
  stranger[texels].ids[77] += 2;
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
