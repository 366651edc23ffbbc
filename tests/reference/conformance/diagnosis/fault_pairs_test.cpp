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
const std::vector<TestVector>& smallVectors() {
  static const std::vector<TestVector> small = [] {
    std::vector<TestVector> vectors = reference::vectorSuite();
    std::erase_if(vectors, [](const TestVector& vector) {
      int pixels = 0;
      for (const reference::VectorFace& face : vector.faces)
        pixels += face.face.scissor.width * face.face.scissor.height;
      return pixels > 1100 || vector.list.indices.size() > 1000;
    });
    return vectors;
  }();
  return small;
}

/// A vector with its known faults, which are drawn several times.
struct Known {
  reference::PlacedVector placed;
  std::vector<reference::Fault> faults;
};

/// The names of the pair that all vectors show together; empty if one fault or none is named.
std::set<std::string> pairNamed(const auto& draw) {
  std::vector<reference::Report> reports;
  std::vector<const TestVector*> pointers;
  for (std::size_t v = 0; v < smallVectors().size(); ++v) {
    reports.push_back(reportOn(smallVectors()[v], draw(v), {}));
    pointers.push_back(&smallVectors()[v]);
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

std::optional<reference::StagedDevice> deviceOf(const Choice& choice, const Known& known) {
  for (const reference::Fault& fault : known.faults)
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
reference::StagedDevice deviceOf(const std::array<Choice, 2>& choices, const Known& known) {
  const auto a = deviceOf(choices[0], known), b = deviceOf(choices[1], known);
  const auto both = a && b ? pairOf(*a, *b) : std::nullopt;
  return both ? *both : a ? *a : b ? *b : reference::StagedDevice{};
}

/// Whether each of two faults shows beside the other one, in at least five vectors.
bool bothShow(const std::array<Choice, 2>& choices, const std::vector<Known>& vectors) {
  std::array<int, 2> shown{};
  for (const Known& known : vectors) {
    const tests::Buffers found = tests::drawAll(deviceOf(choices, known), known.placed);
    for (std::size_t k : {0u, 1u}) {
      const auto alone = deviceOf(choices[k], known);
      shown[k] += !areEqual(found, alone ? tests::drawAll(*alone, known.placed) : known.placed.buffers);
    }
    if (shown[0] >= 5 && shown[1] >= 5) return true;
  }
  return false;
}

}  // namespace

TEST_CASE("commonPair names both of two faults, in at least 15 of 20 random pairs", "[diagnosis]") {
  std::vector<Known> vectors;
  for (const TestVector& vector : smallVectors()) vectors.push_back({placeVector(vector), knownFaults(vector)});
  reference::Random random(47);
  const std::vector<reference::Fault>& faults = vectors.front().faults;
  int named = 0;
  for (int k = 0; k < 20; ++k) {
    std::array<Choice, 2> choices;
    do choices = {choose(random, faults), choose(random, faults)};
    while (choices[0].fault == choices[1].fault || !bothShow(choices, vectors));
    const auto& [first, second] = choices;
    const std::set<std::string> names =
        pairNamed([&](std::size_t v) { return tests::drawAll(deviceOf(choices, vectors[v]), vectors[v].placed); });
    const bool isRight = names == std::set{first.fault, second.fault};
    UNSCOPED_INFO((isRight ? "named: " : "not named: ")
                  << first.fault << ", " << first.variant << " with " << second.fault << ", " << second.variant);
    named += isRight;
  }
  CHECK(named >= 15);
}

TEST_CASE("commonPair names no pair where one fault is enough", "[diagnosis]") {
  const std::set<std::string> faults{"triangles missing", "16-bit depth", "texels at u (N - 1)",  "linear filtering",
                                     "multisampling",     "depth bias",   "y of the view flipped"};
  std::set<std::string> tested;
  for (const tests::Injection& injection : tests::injectedFaults()) {
    if (!faults.contains(injection.fault) || !tested.insert(injection.fault).second) continue;
    const auto names = pairNamed([&](std::size_t v) {
      return injection.draw(smallVectors()[v], tests::SimulatedDevice{.profile = injection.profile});
    });
    INFO(injection.fault << " on " << injection.vector);
    CHECK(names.empty());
  }
}
