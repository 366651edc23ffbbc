// diagnose names the true fault, names indistinguishable faults together, and none for a correct device.
#include "reference/conformance/diagnosis/diagnosis.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "reference/conformance/diagnosis/fault.h"
#include "reference/conformance/diagnosis/verdict_report.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/suite/vector_suite.h"
#include "tests/support/injected_faults.h"
#include "tests/support/staged_drawing.h"

using namespace hemitex;
using raster::ItemBuffer;
using raster::ItemId;
using reference::TestVector;
using tests::Buffers;
using tests::drawAll;
using tests::SimulatedDevice;

namespace {

std::vector<TestVector> wholeSuite() {
  std::vector<TestVector> suite = reference::vectorSuite();
  for (TestVector& vector : reference::sceneVectors(HEMITEX_DATA)) suite.push_back(std::move(vector));
  return suite;
}

const TestVector& named(const std::vector<TestVector>& suite, const std::string& name) {
  const auto found = std::find_if(suite.begin(), suite.end(), [&](const TestVector& v) { return v.name == name; });
  REQUIRE(found != suite.end());
  return *found;
}

std::set<std::string> faultsNamed(const TestVector& vector, const Buffers& found,
                                  const reference::DeviceProfile& profile = {}) {
  std::set<std::string> names;
  for (const reference::Finding& finding : diagnose(vector, judge(vector, found, profile))) names.insert(finding.fault);
  return names;
}

int pixelsOf(const TestVector& vector) {
  int pixels = 0;
  for (const reference::VectorFace& face : vector.faces) pixels += face.face.scissor.width * face.face.scissor.height;
  return pixels;
}

/// Item IDs of neighbours in two pixels of a hundred, as errors besides the fault.
void disturb(Buffers& buffers, std::mt19937& random) {
  for (ItemBuffer& buffer : buffers)
    for (std::size_t p = 1; p < buffer.ids.size(); ++p)
      if (random() % 50 == 0) buffer.ids[p] = buffer.ids[p - 1];
}

}  // namespace

TEST_CASE("diagnose names each known fault and no other", "[diagnosis]") {
  const std::vector<TestVector> suite = wholeSuite();
  std::set<std::string> tested;
  for (const tests::Injection& injection : tests::injectedFaults())
    for (const std::uint32_t seed : {1u, 2u}) {
      tested.insert(injection.fault);
      INFO(injection.fault << " on " << injection.vector << ", seed " << seed);
      const TestVector& vector = named(suite, injection.vector);
      const bool cutsAtView = seed == 2 && injection.profile.looseClipping;
      const Buffers found = injection.draw(vector, SimulatedDevice{injection.profile, seed, cutsAtView});
      const reference::Verdict verdict = judge(vector, found, injection.profile);
      CHECK(hasErrors(verdict));
      const std::vector<reference::Finding> findings = diagnose(vector, verdict);
      INFO(toText(findings));
      const std::set<std::string> names = faultsNamed(vector, found, injection.profile);
      // Where triangles or their texels vanish, other faults look alike.
      const std::set<std::string> likeOthers{"triangles missing", "draws or triangles not drawn",
                                             "index map of another draw", "item ID 0 taken for nothing"};
      CHECK(names.contains(injection.fault));
      if (!likeOthers.contains(injection.fault)) CHECK(names.size() == 1);
    }
  // All that are known.
  for (const char* name : {"layout-r8g8b8a8", "integer-add-32"})
    for (const reference::Fault& fault : knownFaults(named(suite, name))) {
      INFO(fault.name);
      CHECK(tested.count(fault.name) == 1);
    }
}

TEST_CASE("diagnose names the true fault where it names any", "[diagnosis]") {
  const std::vector<TestVector> suite = wholeSuite();
  std::mt19937 random(5);
  for (const char* name : {"layout-r5g6b5", "minified", "magnified", "unique-maps", "shared-vertices", "scissors",
                           "sample-grid-later-nearer", "two-by-two"}) {
    const TestVector& vector = named(suite, name);
    int accused = 0;
    for (const reference::Fault& fault : knownFaults(vector))
      for (const reference::Variant& variant : fault.variants) {
        Buffers found = drawAll(variant.device, vector);
        disturb(found, random);
        const std::set<std::string> names = faultsNamed(vector, found);
        INFO(name << ": " << fault.name << ", " << variant.name << " is called "
                  << (names.empty() ? "" : *names.begin()));
        CHECK((names.empty() || names.count(fault.name) == 1));
        accused += !names.empty();
      }
    INFO(name);
    CHECK((accused > 30 || name == std::string("two-by-two")));
  }
}

TEST_CASE("diagnose names faults together that a vector cannot tell apart", "[diagnosis]") {
  // One map over the whole of a square view: turning over the view, the picture or the map is all the same.
  const std::vector<TestVector> suite = reference::vectorSuite();
  const TestVector& vector = named(suite, "minified");
  TestVector flipped = vector;
  flipped.faces[0].face.y = -flipped.faces[0].face.y;
  CHECK(faultsNamed(vector, drawAll(SimulatedDevice{}, flipped)) ==
        std::set<std::string>{"y of the view flipped", "picture upside down", "index map upside down"});
}

TEST_CASE("diagnose names no fault of a device within its profile", "[diagnosis]") {
  std::uint64_t explained = 0;
  for (const TestVector& vector : wholeSuite())
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
      INFO(vector.name << ", seed " << seed);
      const reference::Verdict verdict = judge(vector, drawAll(SimulatedDevice{{}, seed, seed == 2}, vector), {});
      CHECK(!hasErrors(verdict));
      CHECK(diagnose(vector, verdict).empty());
      for (const reference::PixelVerdict kind : {reference::PixelVerdict::Coverage, reference::PixelVerdict::Texel})
        explained += countVerdicts(verdict)[static_cast<std::size_t>(kind)];
    }
  CHECK(explained > 1000);  // the devices do err
}

TEST_CASE("diagnose names nothing for unknown faults", "[diagnosis]") {
  const std::vector<TestVector> suite = wholeSuite();
  for (const char* name : {"five-faces", "scene-cornell-box-light", "perspective-floor", "perspective-sheet",
                           "layout-r8g8b8a8", "magnified", "depth-stack", "crossing"}) {
    const TestVector& vector = named(suite, name);
    const Buffers right = reference::render(vector);
    const auto check = [&](const std::string& what, const Buffers& found) {
      INFO(name << ": " << what);
      CHECK(faultsNamed(vector, found) == std::set<std::string>{});
    };
    check("three sub-pixels to the right", drawAll({.profile = {}, .shift = 3}, vector));

    std::mt19937 random(3);
    Buffers noisy = right, rolled = right, constant = right, mixed = right, next = right;
    for (std::size_t f = 0; f < right.size(); ++f) {
      for (ItemId& id : noisy[f].ids)
        if (random() % 20 == 0) id ^= 1u << random() % 24;
      for (ItemId& id : next[f].ids)
        if (random() % 20 == 0) id ^= 1;
      std::vector<ItemId>& ids = rolled[f].ids;
      std::rotate(ids.begin(), ids.begin() + static_cast<std::ptrdiff_t>(ids.size() / 3), ids.end());
      for (std::size_t p = 0; p < ids.size(); ++p)
        if (p % 4 != 0) mixed[f].ids[p] = right[f].ids[ids.size() - 1 - p];
      std::fill(constant[f].ids.begin(), constant[f].ids.end(), right[f].ids[ids.size() / 2] ^ 0x55);
    }
    check("random bits", noisy);
    check("elements off by one, which rounding may not excuse", next);
    check("item IDs moved by a third", rolled);
    check("a constant", constant);
    check("three pixels of four turned by half a turn", mixed);
  }
}

TEST_CASE("diagnose names nothing for one wrong pixel, even where a fault gives it", "[diagnosis]") {
  // The last pixel is the only one that shows a back; culling would leave the background there.
  const std::vector<TestVector> suite = reference::vectorSuite();
  const TestVector& vector = named(suite, "layout-r8g8b8a8");
  Buffers found = reference::render(vector);
  REQUIRE(found[0].ids.back() == 0xfffffffe);
  found[0].ids.back() = 0xffffffff;
  CHECK(hasErrors(judge(vector, found, {})));
  CHECK(faultsNamed(vector, found).empty());
}

TEST_CASE("drawOn with a device without faults draws the item IDs of the rules", "[diagnosis]") {
  // Binary64 cannot decide every sample on a texel's border.
  std::uint64_t pixels = 0, different = 0;
  for (const TestVector& vector : wholeSuite()) {
    const Buffers expected = reference::render(vector), found = drawAll(reference::StagedDevice{}, vector);
    for (std::size_t f = 0; f < found.size(); ++f)
      for (std::size_t p = 0; p < found[f].ids.size(); ++p) {
        ++pixels;
        different += found[f].ids[p] != expected[f].ids[p];
      }
  }
  INFO(different << " of " << pixels);
  CHECK(different * 10000 < pixels);
}

TEST_CASE("commonFault over the small vectors of the suite names faults that single vectors take for others",
          "[diagnosis]") {
  // On vectors where these item IDs lack alpha, where all triangles vanish, or where a square map fills a square view,
  // other faults give the same picture.
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::set<std::string> faults{"triangles missing",
                                     "index map not sampled",
                                     "indices cut to fewer bits",
                                     "matrix transposed",
                                     "texture coordinates in half floats",
                                     "index map transposed",
                                     "premultiplied alpha",
                                     "item IDs cut to fewer bits",
                                     "viewport scaled by a pixel ratio",
                                     "vertices snapped to fewer bits",
                                     "depth not cleared between faces"};
  std::set<std::string> tested;
  for (const tests::Injection& injection : tests::injectedFaults()) {
    // The other injection of this fault fits the map of its vector alone.
    if (injection.fault == "index map transposed" && injection.vector == "five-faces") continue;
    if (faults.count(injection.fault) == 0) continue;
    std::vector<reference::Report> reports;
    for (const TestVector& vector : suite)
      if (vector.name == injection.vector || pixelsOf(vector) <= 1600)
        reports.push_back(
            reportOn(vector, injection.draw(vector, SimulatedDevice{injection.profile, 1, false}), injection.profile));
    const auto common = commonFault(reports);
    INFO(injection.fault << " on " << injection.vector << (common ? ": " + toText(*common) : ""));
    if (!common) FAIL_CHECK("no fault is named");
    if (common) CHECK(common->finding.fault == injection.fault);
    tested.insert(injection.fault);
  }
  CHECK(tested == faults);
}

TEST_CASE("commonFault over the small vectors of the suite names faults by more than half of the vectors with errors",
          "[diagnosis]") {
  // Many vectors show these in less than eight pixels, or only within rounding.
  const std::vector<TestVector> suite = reference::vectorSuite();
  const std::set<std::string> faults{"multisampling",
                                     "linear filtering",
                                     "item IDs through binary32",
                                     "16-bit depth",
                                     "conservative rasterization",
                                     "depth bias",
                                     "texels at u (N - 1)",
                                     "u N rounded to binary32",
                                     "item ID interpolated",
                                     "item IDs through half floats",
                                     "tone mapping",
                                     "stale face",
                                     "enlarged picture",
                                     "dilation",
                                     "supersampling averaged"};
  std::set<std::string> tested;
  for (const tests::Injection& injection : tests::injectedFaults()) {
    if (faults.count(injection.fault) == 0) continue;
    std::vector<reference::Report> reports;
    for (const TestVector& vector : suite)
      if (vector.name == injection.vector || pixelsOf(vector) <= 1100)
        reports.push_back(
            reportOn(vector, injection.draw(vector, SimulatedDevice{injection.profile, 1, false}), injection.profile));
    const auto common = commonFault(reports);
    INFO(injection.fault << " on " << injection.vector << (common ? ": " + toText(*common) : ""));
    REQUIRE(common);
    CHECK(common->finding.fault == injection.fault);
    CHECK_FALSE(isWeak(*common));
    tested.insert(injection.fault);
  }
  CHECK(tested == faults);
}

TEST_CASE("commonFault names GL_REPEAT in binary32 by most vectors with errors, in single pixels of which it shows",
          "[diagnosis]") {
  // The part behind the point of a tiny negative number is 1, and its texel N that of 0.
  const auto repeated = [](float coordinate, int size) {
    return static_cast<int>((coordinate - std::floor(coordinate)) * static_cast<float>(size)) % size;
  };
  SimulatedDevice device;
  device.profile.vertexError = 0;
  device.profile.texelPrecision = 0;
  device.fetch = [=](const raster::IndexMap& map, const glm::dvec2& at) {
    const glm::vec2 unit(at / glm::dvec2(map.width, map.height));
    return reference::texelAt(map, glm::dvec2(repeated(unit.x, map.width), repeated(unit.y, map.height)));
  };
  std::vector<reference::Report> reports;
  for (const TestVector& vector : reference::vectorSuite()) {
    const std::string& theme = vector.name;
    if (theme.starts_with("texels-") || theme == "clamped-coordinates" || theme == "borders-on-samples")
      reports.push_back(reportOn(vector, drawAll(device, vector), {}));
  }
  const auto common = commonFault(reports);
  REQUIRE(common);
  INFO(toText(*common));
  CHECK(common->finding.fault == "repeat instead of clamp");
  CHECK(common->failures >= 9);
  CHECK(10 * common->vectors >= 8 * common->failures);
}

TEST_CASE("diagnose does not name a fault by pixels that are explained, where it gives none of the errors",
          "[diagnosis]") {
  // Coordinates just below the exact ones, which a profile explains, repeat at 0: only these pixels are errors.
  SimulatedDevice device;
  device.profile.vertexError = 0;
  device.profile.texelPrecision = 0;
  device.fetch = [](const raster::IndexMap& map, const glm::dvec2& at) {
    const glm::dvec2 size(map.width, map.height), below = at - 0x1p-20;
    return reference::texelAt(map, below - size * glm::floor(below / size));
  };
  const std::vector<TestVector> suite = reference::vectorSuite();
  const TestVector& vector = named(suite, "borders-on-samples");
  const Buffers found = drawAll(device, vector);
  const reference::Verdict verdict = judge(vector, found, {});
  CHECK(countVerdicts(verdict)[static_cast<std::size_t>(reference::PixelVerdict::Error)] == 63);
  CHECK(countVerdicts(verdict)[static_cast<std::size_t>(reference::PixelVerdict::Texel)] == 1024 - 63);
  CHECK(faultsNamed(vector, found).count("texture coordinates just below the exact ones") == 0);
}
