// Each fault of version 2 is found and named in a vector of at most 8 x 8 pixels.
#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <set>

#include "reference/conformance/diagnosis/diagnosis.h"
#include "reference/conformance/diagnosis/fault.h"
#include "reference/conformance/suite/vector_suite.h"
#include "tests/support/staged_drawing.h"

using namespace hemitex;
using reference::TestVector;

namespace {

/// The names of the faults that a device with a variant shows.
std::set<std::string> namesOf(const TestVector& vector, const reference::StagedDevice& device) {
  std::set<std::string> names;
  const reference::Verdict verdict = judge(vector, tests::drawAll(device, vector), {});
  for (const reference::Finding& finding : diagnose(vector, verdict)) names.insert(finding.fault);
  return names;
}

}  // namespace

TEST_CASE("diagnose names each fault of assemblyFaults alone in a vector of at most 8 x 8 pixels", "[faults]") {
  std::map<std::string, std::string> alone;  // by fault: a vector that names nothing else
  std::set<std::string> all;
  for (const TestVector& vector : reference::drawVectors()) {
    for (const reference::VectorFace& face : vector.faces)
      CHECK(face.face.scissor.width * face.face.scissor.height <= 64);
    for (const reference::Fault& fault : assemblyFaults(vector))
      for (const reference::Variant& variant : fault.variants) {
        all.insert(fault.name);
        const std::set<std::string> names = namesOf(vector, variant.device);
        INFO(vector.name << ": " << fault.name << ", " << variant.name << " is called "
                         << (names.empty() ? "" : *names.begin()));
        CHECK((names.empty() || names.contains(fault.name)));
        if (names == std::set{fault.name}) alone[fault.name] = vector.name;
      }
  }
  CHECK(all.size() == 11);
  for (const std::string& fault : all) {
    INFO(fault);
    CHECK(alone.contains(fault));
  }
}

TEST_CASE("diagnose names a face of the frame before in two faces of 8 x 8 pixels", "[faults]") {
  const std::vector<TestVector> vectors = reference::drawVectors();
  const auto vector = std::find_if(vectors.begin(), vectors.end(),
                                   [](const TestVector& v) { return v.name == "front-counter-clockwise"; });
  REQUIRE(vector != vectors.end());
  for (const reference::Fault& fault : knownFaults(*vector))
    if (fault.name == "stale face") {
      CHECK(fault.variants.size() == 2);
      for (const reference::Variant& variant : fault.variants)
        CHECK(namesOf(*vector, variant.device).contains(fault.name));
    }
}

TEST_CASE("A staged device without faults draws drawVectors by the rules", "[faults]") {
  for (const TestVector& vector : reference::drawVectors()) {
    INFO(vector.name);
    const auto drawn = tests::drawAll(reference::StagedDevice{}, vector), expected = render(vector);
    for (std::size_t f = 0; f < drawn.size(); ++f) CHECK(drawn[f].ids == expected[f].ids);
  }
}
