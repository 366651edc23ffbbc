// What five pipelines of a real GPU drew (h200_answers.txt): no pixel is an error under the profile that calibrate
// measures from a pipeline's own answers to the probes, nor under the default profile.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>

#include "reference/conformance/calibration/calibration.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/verdict/verdict.h"

using namespace hemitex;
using raster::ItemBuffer;
using reference::TestVector;

namespace {

/// A line of the file without the name of its vector.
using Answers = std::map<std::string, std::string>;  // by vector

/// By pipeline.
std::map<std::string, Answers> readAnswers() {
  std::ifstream file(HEMITEX_SOURCE "/tests/reference/conformance/calibration/h200_answers.txt");
  std::map<std::string, Answers> pipelines;
  std::string pipeline;
  for (std::string line; std::getline(file, line);) {
    const std::string word = line.substr(0, line.find(' ')), rest = line.substr(line.find(' ') + 1);
    if (word == "pipeline")
      pipeline = rest;
    else if (word != "#")
      pipelines[pipeline][word] = rest;
  }
  return pipelines;
}

/// The item buffers of a vector, from those of the rules and the pixels that differ from them.
std::vector<ItemBuffer> drawn(const TestVector& vector, const std::string& answer) {
  std::vector<ItemBuffer> buffers = reference::render(vector);
  std::istringstream text(answer);
  std::string hash;
  text >> hash;
  std::size_t pixel = 0, face = 0;
  for (long long step = 0, change = 0; text >> step >> change;) {
    pixel += static_cast<std::size_t>(step);
    for (; pixel >= buffers[face].ids.size(); ++face) pixel -= buffers[face].ids.size();
    buffers[face].ids[pixel] += static_cast<raster::ItemId>(change);
  }
  INFO(vector.name);
  CHECK(reference::idsHash(buffers) == hash);
  return buffers;
}

/// The probes that the GPU has drawn: later ones are left out.
reference::ProbingSet recordedProbes() {
  reference::ProbingSet probes = reference::makeProbes();
  std::erase_if(probes.coverage, [](const auto& sheet) { return !sheet.pixels[0].bits.contains(12); });
  probes.sharedEdges.clear();
  probes.clipping.clear();
  return probes;
}

std::uint64_t errorsOf(const std::vector<TestVector>& suite, const std::vector<std::vector<ItemBuffer>>& found,
                       const reference::DeviceProfile& profile) {
  std::uint64_t errors = 0;
  for (std::size_t k = 0; k < suite.size(); ++k)
    errors +=
        countVerdicts(judge(suite[k], found[k], profile))[static_cast<std::size_t>(reference::PixelVerdict::Error)];
  return errors;
}

}  // namespace

TEST_CASE("calibrate finds profiles from the recorded answers of a GPU under which its pixels are no errors",
          "[calibration]") {
  const reference::ProbingSet probes = recordedProbes();
  const std::map<std::string, Answers> pipelines = readAnswers();
  REQUIRE(pipelines.size() == 5);
  const std::vector<TestVector> all = reference::wholeSuite(HEMITEX_DATA);
  for (const auto& [pipeline, answers] : pipelines) {
    INFO(pipeline);
    std::vector<ItemBuffer> toProbes;
    for (const TestVector& probe : vectorsOf(probes)) toProbes.push_back(drawn(probe, answers.at(probe.name)).front());
    const reference::Calibration calibration = calibrate(probes, toProbes);
    CHECK(calibration.faults.empty());
    CHECK(calibration.profile.subpixelBits == 8);
    CHECK(calibration.profile.snapRounding == reference::SnapRounding::Nearest);
    CHECK(calibration.profile.edgeRule == reference::EdgeRule::TopLeft);
    CHECK(calibration.profile.texelPrecision == 0);

    std::vector<TestVector> suite;
    std::vector<std::vector<ItemBuffer>> found;
    for (const TestVector& vector : all)
      if (answers.contains(vector.name)) {
        suite.push_back(vector);
        found.push_back(drawn(vector, answers.at(vector.name)));
      }
    CHECK(suite.size() >= 81);
    CHECK(errorsOf(suite, found, {}) == 0);
    CHECK(errorsOf(suite, found, calibration.profile) == 0);
    if (pipeline == "vulkan") CHECK(calibration.profile.interpolationError == 0);
    if (pipeline != "opengl") continue;
    // It interpolates exactly, but multiplies u by N in binary32.
    CHECK(calibration.profile.interpolationError >= 1);
    CHECK(calibration.profile.interpolationError <= 4);
    reference::DeviceProfile exact = calibration.profile;
    exact.interpolationError = 0;
    CHECK(errorsOf(suite, found, exact) == 1630);
  }
}
