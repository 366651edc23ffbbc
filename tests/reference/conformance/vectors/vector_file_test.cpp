// Test vectors on disk: they read back as written, and readVector refuses files that break the format.
#include "reference/conformance/vectors/vector_file.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>

#include "raster/base/input_error.h"
#include "tests/support/raster_scenes.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using reference::TestVector;

namespace {

TestVector sample() {
  TestVector vector;
  vector.name = "two \"quoted\" draws";
  vector.origin = {1.0 / 3, -1e6, 0.1};
  vector.list.format = {{8, 8, 8}};
  vector.list.indexMaps = {tests::countingMap(4, 2), tests::countingMap(3, 3)};
  tests::addDraw(vector.list, 0x100, 0xfffffe, 0);
  tests::addTriangle(vector.list, {{-1.1f, -1, 1.7f}, {3, -1, 1}, {-1, 1.0f / 3, 1e-7f}}, {{0, 0}, {0.1f, 0}, {0, 1}});
  tests::addDraw(vector.list, 0x200, {}, 1);
  tests::addTriangle(vector.list, {{-1, -1, 1}, {3, -1, 1}, {-1, 3, 1}});
  tests::addDraw(vector.list, 0x300);
  tests::addTriangle(vector.list, {{-1, -1, 2}, {3, -1, 2}, {-1, 3, 2}});
  raster::Face face = tests::frontFace(16);
  vector.faces.push_back({"top", face, "top.u32", ""});
  face.eye = {0.1f, 0.2f, 0.3f};
  face.scissor = {0, 8, 16, 8};
  vector.faces.push_back({"side", face, "side.u32", ""});
  return vector;
}

std::string contents(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("readVector reads back the bits that writeVector wrote", "[vector]") {
  const TemporaryFolder folder;
  const TestVector written = sample();
  writeVector(folder.path, written, {});
  const TestVector read = reference::readVector(folder.path);
  CHECK(read.name == written.name);
  CHECK(read.origin == written.origin);
  CHECK(read.list.positions == written.list.positions);
  CHECK(read.list.texcoords == written.list.texcoords);
  CHECK(read.list.indices == written.list.indices);
  CHECK(read.list.format == written.list.format);
  REQUIRE(read.list.draws.size() == 3);
  for (std::size_t d = 0; d < 3; ++d) {
    CHECK(read.list.draws[d].offset == written.list.draws[d].offset);
    CHECK(read.list.draws[d].back == written.list.draws[d].back);
    CHECK(read.list.draws[d].indexMap == written.list.draws[d].indexMap);
  }
  REQUIRE(read.list.indexMaps.size() == 2);
  CHECK(read.list.indexMaps[0].ids == written.list.indexMaps[0].ids);
  REQUIRE(read.faces.size() == 2);
  CHECK(read.faces[0].face.eye == written.faces[0].face.eye);
  CHECK(read.faces[1].face.eye == written.faces[1].face.eye);
  CHECK(read.faces[1].face.scissor.row == 8);
  CHECK(read.faces[1].hash.empty());
}

TEST_CASE("writeVector writes version 1 as before, and version 2 where a draw culls or an index map has a hole",
          "[vector]") {
  const auto textOf = [](const TestVector& vector) {
    const TemporaryFolder folder;
    writeVector(folder.path, vector, {});
    const TestVector read = reference::readVector(folder.path);
    for (std::size_t d = 0; d < 3; ++d) CHECK(read.list.draws[d].cull == vector.list.draws[d].cull);
    CHECK(read.list.indexMaps[1].ids == vector.list.indexMaps[1].ids);
    return contents(folder.path / "vector.json");
  };
  const std::string old = textOf(sample());
  CHECK(old.find("\"rules\": 1,") != std::string::npos);
  CHECK(old.find("cull") == std::string::npos);
  TestVector open = sample(), culling = sample();
  open.list.indexMaps[1].ids[4] = raster::holeTexel;
  std::string text = textOf(open);
  REQUIRE(text.find("\"rules\": 2,") != std::string::npos);
  text[text.find("\"rules\": 2,") + 9] = '1';
  CHECK(text == old);
  for (const raster::Cull cull : {raster::Cull::Front, raster::Cull::Back}) {
    culling.list.draws[2].cull = cull;
    text = textOf(culling);
    CHECK(text.find("\"rules\": 2,") != std::string::npos);
    CHECK(text.find(cull == raster::Cull::Front ? "\"cull\": \"front\"" : "\"cull\": \"back\"") != std::string::npos);
  }
}

TEST_CASE("readVector reads back triangle numbers, depth tests, viewports and sample places", "[vector]") {
  TestVector written = sample();
  written.list.value = raster::PixelValue::TriangleNumbers;
  written.list.depthTest = raster::DepthTest::FartherOrEqual;
  for (reference::VectorFace& face : written.faces) {
    face.face.viewport = raster::Viewport{300, 17};
    face.face.sample = raster::SamplePlace::Corner;
  }
  const TemporaryFolder folder;
  writeVector(folder.path, written, reference::render(written));
  const std::string text = contents(folder.path / "vector.json");
  for (const char* line : {"\"rules\": 2,", "\"values\": \"triangle-numbers\"", "\"depth_test\": \"farther-or-equal\"",
                           "\"sample\": \"corner\""})
    CHECK(text.find(line) != std::string::npos);
  const TestVector read = reference::readVector(folder.path);
  CHECK(read.list.value == written.list.value);
  CHECK(read.list.depthTest == written.list.depthTest);
  for (const reference::VectorFace& face : read.faces) {
    CHECK(face.face.viewport == raster::Viewport{300, 17});
    CHECK(face.face.sample == raster::SamplePlace::Corner);
  }
  const std::vector<raster::ItemBuffer> candidate = reference::readCandidate(folder.path, read);
  CHECK(candidate[1].ids == reference::render(read)[1].ids);
}

TEST_CASE("readVector refuses keys and values of version 2 in version 1, and unknown ones", "[vector]") {
  const auto refusal = [](const TestVector& vector, const std::string& from, const std::string& to) -> std::string {
    const TemporaryFolder folder;
    writeVector(folder.path, vector, {});
    std::string json = contents(folder.path / "vector.json");
    json.replace(json.find(from), from.size(), to);
    std::ofstream(folder.path / "vector.json") << json;
    try {
      reference::readVector(folder.path);
      return {};
    } catch (const raster::InputError& error) {
      return error.what();
    }
  };
  TestVector open = sample(), culling = sample();
  open.list.indexMaps[1].ids[4] = raster::holeTexel;
  culling.list.draws[2].cull = raster::Cull::Back;
  TestVector numbered = sample(), farther = sample(), corner = sample(), wide = sample();
  numbered.list.value = raster::PixelValue::TriangleNumbers;
  farther.list.depthTest = raster::DepthTest::Farther;
  for (reference::VectorFace& face : corner.faces) face.face.sample = raster::SamplePlace::Corner;
  for (reference::VectorFace& face : wide.faces) face.face.viewport = raster::Viewport{17, 16};
  for (const TestVector& vector : {open, culling, numbered, farther, corner, wide}) {
    CHECK(refusal(vector, "\"rules\": 2", "\"rules\": 1").find("\"rules\": 2") != std::string::npos);
    CHECK(refusal(vector, "\"rules\": 2", "\"rules\": 2").empty());
  }
  CHECK(refusal(culling, "\"cull\": \"back\"", "\"cull\": \"both\"").find("none, front, back") != std::string::npos);
  CHECK(refusal(farther, "\"farther\"", "\"less\"").find("nearer-or-equal") != std::string::npos);
  CHECK(refusal(numbered, "triangle-numbers", "triangles").find("triangle-numbers") != std::string::npos);
  CHECK(refusal(sample(), "\"rules\": 1", "\"rules\": 2").empty());
}

TEST_CASE("writeVector writes one item ID per pixel and the hash of the bytes", "[vector]") {
  const TemporaryFolder folder;
  const TestVector vector = sample();
  raster::SoftwareRenderer renderer(vector.list);
  const std::vector<raster::Face> faces{vector.faces[0].face, vector.faces[1].face};
  const std::vector<raster::ItemBuffer> buffers = render(renderer, faces, {});
  writeVector(folder.path, vector, buffers);
  const std::string bytes = contents(folder.path / "side.u32");
  REQUIRE(bytes.size() == 16 * 8 * 4);
  // FNV-1a, 64 bits, over the bytes as they stand in the file.
  std::uint64_t hash = 14695981039346656037u;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 1099511628211u;
  std::ostringstream digits;
  digits << std::hex << hash;
  const TestVector read = reference::readVector(folder.path);
  CHECK(read.faces[1].hash == std::string(16 - digits.str().size(), '0') + digits.str());
  CHECK(read.faces[1].hash == reference::idsHash(buffers[1].ids));
  CHECK(reference::idsHash(std::vector<raster::ItemId>{}) == "cbf29ce484222325");  // the offset basis of FNV-1a
}

TEST_CASE("readVector throws with the name of the file that breaks the format", "[vector]") {
  struct Case {
    std::string from, to;  // a replacement in vector.json
  };
  const std::vector<Case> cases{
      {"\"rules\": 1", "\"rules\": 3"},
      {"\"rules\": 1,", ""},
      {"\"resolution\": 16", "\"resolution\": 15"},
      {"\"resolution\": 16", "\"resolution\": 16.5"},
      {"\"resolution\": 16", "\"resolution\": 18446744073709551615"},
      {"\"background\": 16777215", "\"background\": 0"},
      {"clamped-add", "saturate"},
      {"positions.f32", "missing.f32"},
      {"positions.f32", "../positions.f32"},
      {"positions.f32", "indices.u32"},
      {"\"count\": 3", "\"count\": 30"},
      {"\"offset\": 256", "\"offset\": -1"},
      {"\"offset\": 256", "\"offset\": 16777215"},
      {"\"width\": 4", "\"width\": 5"},
      {"side.u32", "top.u32"},
      {"side.u32", "indices.u32"},
      {"\"near\": ", "\"near\": 1e300, \"far\": "},
      {"\"near\": ", "\"near\": -"},
      {"\"faces\": [", "\"faces\": [5, "},
      {"{", "{{"},
  };
  for (const Case& broken : cases) {
    const TemporaryFolder folder;
    writeVector(folder.path, sample(), {});
    std::string json = contents(folder.path / "vector.json");
    const std::size_t place = json.find(broken.from);
    INFO(broken.from << " -> " << broken.to);
    REQUIRE(place != std::string::npos);
    json.replace(place, broken.from.size(), broken.to);
    std::ofstream(folder.path / "vector.json") << json;
    try {
      reference::readVector(folder.path);
      FAIL("read without complaint");
    } catch (const raster::InputError& error) {
      CHECK(std::string(error.what()).find(folder.path.string()) != std::string::npos);
    }
  }
}

TEST_CASE("readVector throws for truncated arrays and missing vectors", "[vector]") {
  const TemporaryFolder folder;
  CHECK_THROWS_AS(reference::readVector(folder.path), raster::InputError);
  writeVector(folder.path, sample(), {});
  std::filesystem::resize_file(folder.path / "positions.f32", 35);
  CHECK_THROWS_AS(reference::readVector(folder.path), raster::InputError);
  std::filesystem::resize_file(folder.path / "positions.f32", 24);
  CHECK_THROWS_AS(reference::readVector(folder.path), raster::InputError);
}

TEST_CASE("readVector throws for a folder in place of a file", "[vector]") {
  for (const char* file : {"vector.json", "positions.f32", "texcoords.f32", "indices.u32", "map-0-4x2.u32"}) {
    const TemporaryFolder folder;
    writeVector(folder.path, sample(), {});
    std::filesystem::remove(folder.path / file);
    std::filesystem::create_directory(folder.path / file);
    INFO(file);
    CHECK_THROWS_AS(reference::readVector(folder.path), raster::InputError);
  }
}
