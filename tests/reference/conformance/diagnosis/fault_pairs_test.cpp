// Two faults at once are named both, from the whole suite; a single fault is not called two.
#include <algorithm>
#include <catch2/catch.hpp>
#include <set>

#include "reference/conformance/diagnosis/device_pair.h"
#include "reference/conformance/diagnosis/fault.h"
#include "reference/conformance/diagnosis/verdict_report.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "tests/support/injected_faults.h"
#include "tests/support/staged_drawing.h"

using namespace hemitex;
using reference::TestVector;

namespace {

/// The vectors of the suite with few pixels and triangles.
std::vector<TestVector> smallVectors() {
  std::vector<TestVector> vectors = reference::vectorSuite();
  std::erase_if(vectors, [](const TestVector& vector) {
    int pixels = 0;
    for (const reference::VectorFace& face : vector.faces) pixels += face.face.scissor.width * face.face.scissor.height;
    return pixels > 1100 || vector.list.indices.size() > 1000;
  });
  return vectors;
}

/// The names of the pair that all vectors show together; empty if one fault or none is named.
std::set<std::string> pairNamed(const std::vector<TestVector>& vectors, const auto& draw) {
  std::vector<reference::Report> reports;
  std::vector<const TestVector*> pointers;
  for (const TestVector& vector : vectors) {
    reports.push_back(reportOn(vector, draw(vector), {}));
    pointers.push_back(&vector);
  }
  const auto pair = commonPair(reports, pointers);
  if (!pair) {
    if (const auto common = commonFault(reports)) UNSCOPED_INFO("alone: " << toText(*common));
    return {};
  }
  UNSCOPED_INFO(toText(*pair));
  return {pair->findings[0].fault, pair->findings[1].fault};
}

/// The place of a fault and of one of its variants, among those that every vector knows.
struct Choice {
  std::string fault, variant;
};

std::optional<reference::StagedDevice> deviceOf(const Choice& choice, const TestVector& vector) {
  for (const reference::Fault& fault : knownFaults(vector))
    for (const reference::Variant& variant : fault.variants)
      if (fault.name == choice.fault && variant.name == choice.variant) return variant.device;
  return {};
}

Choice choose(reference::Random& random, const std::vector<reference::Fault>& faults) {
  for (;;) {
    const reference::Fault& fault = faults[random.below(static_cast<std::uint32_t>(faults.size()))];
    if (fault.variants.empty()) continue;
    const reference::Variant& variant = fault.variants[random.below(static_cast<std::uint32_t>(fault.variants.size()))];
    if (!variant.isPartial) return {fault.name, variant.name};
  }
}

bool areEqual(const tests::Buffers& a, const tests::Buffers& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const raster::ItemBuffer& x, const raster::ItemBuffer& y) { return x.ids == y.ids; });
}

/// The device with both faults as a vector knows them.
reference::StagedDevice deviceOf(const std::array<Choice, 2>& choices, const TestVector& vector) {
  const auto a = deviceOf(choices[0], vector), b = deviceOf(choices[1], vector);
  const auto both = a && b ? pairOf(*a, *b) : std::nullopt;
  return both ? *both : a ? *a : b ? *b : reference::StagedDevice{};
}

/// Whether each of two faults shows beside the other one, in at least five vectors.
bool bothShow(const std::array<Choice, 2>& choices, const std::vector<TestVector>& vectors) {
  std::array<int, 2> shown{};
  for (const TestVector& vector : vectors) {
    const tests::Buffers found = tests::drawAll(deviceOf(choices, vector), vector);
    for (std::size_t k : {0u, 1u}) {
      const auto alone = deviceOf(choices[k], vector);
      shown[k] += !areEqual(found, tests::drawAll(alone ? *alone : reference::StagedDevice{}, vector));
    }
  }
  return shown[0] >= 5 && shown[1] >= 5;
}

}  // namespace

TEST_CASE("commonPair names both of two faults, in at least 15 of 20 random pairs", "[diagnosis]") {
  const std::vector<TestVector> vectors = smallVectors();
  reference::Random random(47);
  const std::vector<reference::Fault> faults = knownFaults(vectors.front());
  int named = 0;
  for (int k = 0; k < 20; ++k) {
    std::array<Choice, 2> choices;
    do choices = {choose(random, faults), choose(random, faults)};
    while (choices[0].fault == choices[1].fault || !bothShow(choices, vectors));
    const auto& [first, second] = choices;
    const auto draw = [&](const TestVector& vector) { return tests::drawAll(deviceOf(choices, vector), vector); };
    const std::set<std::string> names = pairNamed(vectors, draw);
    const bool isRight = names == std::set{first.fault, second.fault};
    UNSCOPED_INFO((isRight ? "named: " : "not named: ")
                  << first.fault << ", " << first.variant << " with " << second.fault << ", " << second.variant);
    named += isRight;
  }
  CHECK(named >= 15);
}

TEST_CASE("commonPair names no pair where one fault is enough", "[diagnosis]") {
  const std::vector<TestVector> vectors = smallVectors();
  const std::set<std::string> faults{"16-bit depth",  "texels at u (N - 1)", "linear filtering",
                                     "multisampling", "depth bias",          "y of the view flipped"};
  std::set<std::string> tested;
  for (const tests::Injection& injection : tests::injectedFaults()) {
    if (!faults.contains(injection.fault) || !tested.insert(injection.fault).second) continue;
    const auto names = pairNamed(vectors, [&](const TestVector& vector) {
      return injection.draw(vector, tests::SimulatedDevice{.profile = injection.profile});
    });
    INFO(injection.fault << " on " << injection.vector);
    CHECK(names.empty());
  }
}
