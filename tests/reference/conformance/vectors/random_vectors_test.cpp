// Random vectors are the same everywhere, follow the rules, detect all known faults, and pairs hold their relation.
#include "reference/conformance/vectors/random_vectors.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "raster/base/input_error.h"
#include "raster/base/parallel.h"
#include "reference/conformance/diagnosis/fault.h"
#include "reference/conformance/trace/rational_rasterizer.h"
#include "reference/conformance/vectors/vector_file.h"
#include "reference/conformance/verdict/verdict.h"
#include "tests/support/random_pairs.h"
#include "tests/support/staged_drawing.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using raster::ItemId;
using reference::TestVector;

namespace {

using Ids = std::vector<ItemId>;

void append(Ids& bits, const glm::vec3& v) {
  for (const float x : {v.x, v.y, v.z}) bits.push_back(std::bit_cast<std::uint32_t>(x));
}

/// All bits of a vector's input and its item IDs.
Ids bitsOf(const TestVector& vector) {
  Ids bits;
  for (const glm::vec3& position : vector.list.positions) append(bits, position);
  for (const glm::vec2& t : vector.list.texcoords) append(bits, {t.x, t.y, 0});
  bits.insert(bits.end(), vector.list.indices.begin(), vector.list.indices.end());
  for (const raster::IndexMap& map : vector.list.indexMaps) bits.insert(bits.end(), map.ids.begin(), map.ids.end());
  for (const raster::Draw& draw : vector.list.draws) {
    bits.insert(bits.end(), {draw.first, draw.count, draw.offset, draw.back.value_or(0)});
    if (draw.cull != raster::Cull::None) bits.push_back(static_cast<ItemId>(draw.cull));
  }
  if (vector.list.value != raster::PixelValue::ItemIds || vector.list.depthTest != raster::DepthTest::Nearer)
    bits.insert(bits.end(), {static_cast<ItemId>(vector.list.value), static_cast<ItemId>(vector.list.depthTest)});
  const raster::DrawList& source = sourceOf(vector);
  if (vector.source || !source.clipZ.empty()) {
    for (const float z : source.clipZ) append(bits, glm::vec3(z));
    bits.insert(bits.end(), source.indices.begin(), source.indices.end());
    bits.insert(bits.end(), source.vertexValues.begin(), source.vertexValues.end());
  }
  for (const raster::Face& face : facesOf(vector))
    if (!isUsual(face)) bits.push_back(static_cast<ItemId>(face.sample));
  for (const raster::Face& face : facesOf(vector))
    for (const glm::vec3& row : {face.eye, face.x, face.y, face.w, glm::vec3(face.nearDistance)}) append(bits, row);
  for (const raster::ItemBuffer& buffer : reference::render(vector))
    bits.insert(bits.end(), buffer.ids.begin(), buffer.ids.end());
  return bits;
}

/// The hash of the vectors of seeds 0 to 99.
std::string hashOf(const std::string& family) {
  Ids bits;
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    const Ids more = bitsOf(reference::randomVector(seed, family));
    bits.insert(bits.end(), more.begin(), more.end());
  }
  return reference::idsHash(bits);
}

/// The number of vectors on which renderer and evaluateRules differ.
std::uint64_t vectorsUnlikeRules(std::uint64_t count) {
  std::atomic<std::uint64_t> differing = 0;
  raster::parallelFor(count, [&](std::size_t k) {
    const TestVector vector = reference::interleavedRandomVector(0, k);
    const std::vector<raster::ItemBuffer> found = reference::render(vector);
    bool isEqual = true;
    for (std::size_t f = 0; f < found.size(); ++f)
      isEqual &= found[f].ids == reference::evaluateRules(sourceOf(vector), vector.faces[f].face).ids;
    differing += !isEqual;
  });
  return differing;
}

bool haveEqualBuffers(const std::vector<raster::ItemBuffer>& a, const std::vector<raster::ItemBuffer>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const raster::ItemBuffer& x, const raster::ItemBuffer& y) { return x.ids == y.ids; });
}

/// The number of pairs among `count` whose item buffers are equal as `draw` draws them.
template <typename Draw>
int equalPairs(tests::Relation relation, std::uint64_t count, const Draw& draw) {
  int equal = 0;
  for (std::uint64_t seed = 0; seed < count; ++seed) {
    const tests::VectorPair pair = tests::randomPair(seed, relation);
    equal += haveEqualBuffers(draw(pair.first), draw(pair.second));
  }
  return equal;
}

/// How many vectors it takes until one shows the fault, or the variant, which has the name of its fault in front.
struct Detections {
  std::map<std::string, std::uint64_t> faults, variants;
};

/// A profile that excludes the effect of a fault, where the default explains it.
reference::DeviceProfile profileAgainst(const std::string& fault) {
  reference::DeviceProfile profile;
  profile.strictDepth = fault == "equal depths pass the depth test";
  profile.looseClipping = fault != "clipping at other planes";
  if (fault == "texture coordinates just below the exact ones") profile.texelPrecision = 0;
  return profile;
}

/// Whether a device has errors that a device without faults has not.
bool hasOwnErrors(const TestVector& vector, const reference::StagedDevice& device,
                  const reference::DeviceProfile& profile) {
  return hasErrors(judge(vector, tests::drawAll(device, vector), profile)) &&
         !hasErrors(judge(vector, tests::drawAll(reference::StagedDevice{}, vector), profile));
}

/// Draws the first `count` vectors with all known faults. Faults without errors get `count` + 1.
Detections detectFaults(std::uint64_t count) {
  Detections detections;
  for (std::uint64_t k = 0; k < count; ++k) {
    const TestVector vector = reference::interleavedRandomVector(0, k);
    for (const reference::Fault& fault : knownFaults(vector))
      for (const reference::Variant& variant : fault.variants) {
        std::uint64_t& ofFault = detections.faults.try_emplace(fault.name, count + 1).first->second;
        std::uint64_t& ofVariant =
            detections.variants.try_emplace(fault.name + ", " + variant.name, count + 1).first->second;
        if (ofVariant <= count || !hasOwnErrors(vector, variant.device, profileAgainst(fault.name))) continue;
        ofVariant = k + 1;
        ofFault = std::min(ofFault, k + 1);
      }
  }
  return detections;
}

}  // namespace

TEST_CASE("randomVector gives pinned vectors for the first hundred seeds of each family", "[random]") {
  const std::map<std::string, std::string> pinned{{"generic", "95ba56d3e753e792"},
                                                  {"slivers", "a32df0d77b67a939"},
                                                  {"sample-ties", "fda08b74dc47f950"},
                                                  {"near-plane", "552c4a7641d339b9"},
                                                  {"guard-band", "e2be987de99a15d5"},
                                                  {"far-from-zero", "6c71b4fa4d0f4b20"},
                                                  {"depth-ratios", "059111249301515c"},
                                                  {"depth-ties", "0b955c254020fde2"},
                                                  {"close-depths", "84c11b38a7a5be3a"},
                                                  {"texel-borders", "f62a6a0f42de3650"},
                                                  {"minified-maps", "2ed5da773a124375"},
                                                  {"facing", "f937bca42688f304"},
                                                  {"views", "d7e28f760e2b3bdc"},
                                                  {"shared-vertices", "0737da0c331f3c6e"},
                                                  {"channel-sums", "231a1518d365911a"},
                                                  {"integer-sums", "ccb5750dc9b45427"},
                                                  {"replaced-ids", "f835e40c01de3ef1"},
                                                  {"aligned-ids", "164d63d109f52381"},
                                                  {"equal-depths", "ce7904759cb3e8b6"},
                                                  {"many-vertices", "e113e9949e72b479"},
                                                  {"long-edges", "9985eee5ebedf008"},
                                                  {"constant-coordinates", "1541d1f22cc175c2"},
                                                  {"fine-coordinates", "787f8a368e3b6391"},
                                                  {"holes", "4de001229fbb81f9"},
                                                  {"culled-sides", "579c44020b90f666"},
                                                  {"two-sided", "8cb41c75985d105e"},
                                                  {"triangle-numbers", "2a2732b801622685"},
                                                  {"depth-tests", "c87ad26e9bbbd48c"},
                                                  {"viewports", "06fad210ee83c739"},
                                                  {"clip-space", "a9a72ec459e30ac3"},
                                                  {"assemblies", "9c532c2fc4a11be3"}};
  CHECK(pinned.size() == reference::randomFamilies().size() + reference::newRandomFamilies().size());
  for (const auto& [family, hash] : pinned) {
    INFO(family);
    CHECK(hashOf(family) == hash);
  }
}

TEST_CASE("randomVector names the vector by family and seed, and refuses unknown families with all names", "[random]") {
  CHECK(reference::randomVector(17, "slivers").name == "slivers-17");
  try {
    reference::randomVector(1, "splinters");
    FAIL("no error");
  } catch (const raster::InputError& error) {
    const std::string text = error.what();
    CHECK(text.find("splinters") != std::string::npos);
    for (const reference::RandomFamily& family : reference::randomFamilies())
      CHECK(text.find(family.name) != std::string::npos);
  }
}

TEST_CASE("interleavedRandomVector gives each family once per seed", "[random]") {
  std::set<std::string> names;
  const std::size_t families = reference::randomFamilies().size();
  for (std::uint64_t k = 0; k < 3 * families; ++k) names.insert(reference::interleavedRandomVector(5, k).name);
  CHECK(names.size() == 3 * families);
  for (const char* name : {"generic-5", "generic-7", "aligned-ids-5", "aligned-ids-7"}) CHECK(names.count(name) == 1);
}

TEST_CASE("readVector reads vectors of randomVector back to the same bits", "[random]") {
  const TemporaryFolder folder;
  for (const auto& families : {reference::randomFamilies(), reference::newRandomFamilies()})
    for (const reference::RandomFamily& family : families) {
      const TestVector vector = reference::randomVector(3, family.name);
      reference::writeVector(folder.path, vector, reference::render(vector));
      INFO(family.name);
      CHECK(bitsOf(reference::readVector(folder.path)) == bitsOf(vector));
    }
}

TEST_CASE("evaluateRules equals the renderer on 10,000 vectors of interleavedRandomVector", "[random]") {
  CHECK(vectorsUnlikeRules(10000) == 0);
}

// The target million_vectors runs it; the test above is a part of it.
TEST_CASE("evaluateRules equals the renderer on a million vectors of interleavedRandomVector", "[.million_vectors]") {
  CHECK(vectorsUnlikeRules(1000000) == 0);
}

TEST_CASE("judge finds each fault of knownFaults in two vectors of each family, and each variant with an effect",
          "[random]") {
  // No format has channels that the first one changes, and no random vector the vertices that the second one needs.
  // Random coordinates lie too rarely beside a border of texels for the product with u to be rounded over it.
  // They have one index map, faces of one tile of 16 x 16 pixels, and draws of one triangle.
  const std::string rounded = "u N rounded to binary32", otherMap = "index map of another draw";
  const std::set<std::string> withoutEffect{"dithering, 8-8-8",
                                            "indices cut to fewer bits, 16 bits",
                                            rounded + ", at pixels",
                                            rounded + ", at vertices",
                                            otherMap + ", the first draw",
                                            otherMap + ", the last draw",
                                            otherMap + ", the draw before",
                                            otherMap + ", the next draw",
                                            "tiled memory read as rows, 16 x 16 pixels",
                                            "draws or triangles not drawn, all but the first third of each draw"};
  constexpr std::uint64_t count = 300;
  const Detections detections = detectFaults(count);
  CHECK(detections.faults.size() > 50);
  for (const auto& [fault, vectors] : detections.faults) {
    INFO(fault << ": " << vectors);
    if (fault != rounded && fault != otherMap) CHECK(vectors <= 2 * reference::randomFamilies().size());
  }
  CHECK(detections.variants.size() > 250);
  for (const auto& [variant, vectors] : detections.variants) {
    INFO(variant << ": " << vectors);
    CHECK((vectors <= count) != withoutEffect.contains(variant));
  }
}

TEST_CASE("randomPair gives different vectors with equal item buffers, most of which show triangles", "[random]") {
  constexpr std::uint64_t count = 2000;
  for (const tests::Relation relation : tests::allRelations) {
    INFO("relation " << static_cast<int>(relation));
    CHECK(equalPairs(relation, count, reference::render) == count);
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
      const tests::VectorPair pair = tests::randomPair(seed, relation);
      CHECK(bitsOf(pair.first) != bitsOf(pair.second));
      const Ids ids = reference::render(pair.first)[0].ids;
      CHECK(std::count(ids.begin(), ids.end(), raster::backgroundId(pair.first.list.format)) < 200);
    }
  }
}

TEST_CASE("randomPair detects faults without expected item IDs", "[random]") {
  const auto equalWith = [](const reference::StagedDevice& device, tests::Relation relation) {
    return equalPairs(relation, 100, [&](const TestVector& vector) { return tests::drawAll(device, vector); });
  };
  reference::StagedDevice affine, withoutDepthTest;
  affine.interpolate = [](const raster::SnappedTriangle& triangle, const raster::SnappedPoint& position) {
    const glm::dvec3 sum = reference::weightedSum(triangle, weightsAt(triangle, position), [](double) { return 1.0; });
    return glm::dvec2(sum) / sum.z;
  };
  withoutDepthTest.passes = [](double, double) { return true; };
  CHECK(equalWith(affine, tests::Relation::SplitTriangle) < 90);
  CHECK(equalWith(affine, tests::Relation::PermutedDraws) == 100);
  CHECK(equalWith(withoutDepthTest, tests::Relation::PermutedDraws) < 50);
}
