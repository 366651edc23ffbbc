// Vectors of version 2 on disk: strips, instances, positions in clip space and pairs read back as written.
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <sstream>

#include "raster/base/input_error.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/array_file.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using reference::TestVector;

namespace {

/// The contents of the files of a folder, by name.
std::map<std::string, std::string> filesOf(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream stream(entry.path(), std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    files[entry.path().filename().string()] = text.str();
  }
  return files;
}

const TestVector& named(const std::vector<TestVector>& vectors, const std::string& name) {
  for (const TestVector& vector : vectors)
    if (vector.name == name) return vector;
  throw std::runtime_error(name);
}

}  // namespace

TEST_CASE("drawVectors read back as written, with the item buffers of candidates", "[vector]") {
  for (const TestVector& vector : reference::drawVectors()) {
    INFO(vector.name);
    const TemporaryFolder folder, again;
    const std::vector<raster::ItemBuffer> buffers = render(vector);
    writeVector(folder.path, vector, buffers);
    const TestVector read = reference::readVector(folder.path);
    const std::vector<raster::ItemBuffer> shown = render(read);
    writeVector(again.path, read, shown);
    CHECK(filesOf(folder.path) == filesOf(again.path));
    const std::vector<raster::ItemBuffer> candidate = reference::readCandidate(folder.path, read);
    for (std::size_t f = 0; f < buffers.size(); ++f) CHECK(candidate[f].ids == buffers[f].ids);
    CHECK(filesOf(folder.path).at("vector.json").find("\"rules\": 2") != std::string::npos);
  }
}

TEST_CASE("The file of a face of pairs holds 64 bits per pixel", "[vector]") {
  const std::vector<TestVector> vectors = reference::drawVectors();
  const TestVector& vector = named(vectors, "pairs");
  const TemporaryFolder folder;
  writeVector(folder.path, vector, render(vector));
  const auto pairs = reference::readArray<std::uint64_t>(folder.path / "front.u32");
  REQUIRE(pairs.size() == 64);
  // Rows 2s and 2s + 1 show draw s; a block has the triangles 2b and 2b + 1.
  const auto drawOf = [&](std::size_t pixel) { return pairs[pixel] >> 32; };
  const auto triangleOf = [&](std::size_t pixel) { return pairs[pixel] & 0xffffffff; };
  CHECK(drawOf(0) == 0);
  CHECK(triangleOf(0) < 2);
  CHECK(drawOf(5 * 8) == 140000);
  CHECK(triangleOf(5 * 8 + 7) >= 2);
  CHECK(drawOf(63) == 0xfffffffe);
  CHECK(triangleOf(3 * 8 + 3) >= 4);
  // A pair that no draw has is an error like any other.
  std::vector<std::uint64_t> wrong = pairs;
  wrong[9] += 1000;
  reference::writeArray(folder.path / "front.u32", wrong);
  const raster::ItemBuffer found = reference::readCandidate(folder.path, vector)[0];
  CHECK(found.ids[9] == 0xfffffffe);
  std::filesystem::resize_file(folder.path / "front.u32", 256);
  CHECK_THROWS_AS(reference::readCandidate(folder.path, vector), raster::InputError);
}

TEST_CASE("readVector refuses version 2 where a value is out of range", "[vector]") {
  struct Case {
    const char *vector, *from, *to;
  };
  const std::array<Case, 17> cases{{{"clip-perspective", "zero-to-one", "zero-to-two"},
                                    {"clip-perspective", "\"rules\": 2", "\"rules\": 1"},
                                    {"clip-perspective", "\"eye\": [\n    0.0", "\"eye\": [\n    1.0"},
                                    {"clip-perspective", "clip_depth", "clip_deepness"},
                                    {"depth-unorm16", "\"unorm16\"", "\"unorm15\""},
                                    {"front-clockwise", "\"clockwise\"", "\"left\""},
                                    {"provoking-last", "\"last\"", "\"middle\""},
                                    {"provoking-last", "\"vertex_values\"", "\"values_of_vertices\""},
                                    {"provoking-last", "vertex-values.u32", "indices.u32"},
                                    {"provoking-last", "vertex-values.u32", "front.u32"},
                                    {"restart-strip", "\"strip\"", "\"line\""},
                                    {"restart-strip", "\"restart\": true", "\"restart\": 1"},
                                    {"restart-strip", "\"restart\": true", "\"restart\": false"},
                                    {"restart-strip", "\"base_vertex\": 5", "\"base_vertex\": 50"},
                                    {"instances", "\"instance_count\": 4", "\"instance_count\": 5"},
                                    {"instances", "\"id\": 256", "\"id\": -1"},
                                    {"instances", "\"scale\": [", "\"scale\": [1.0, "}}};
  const std::vector<TestVector> vectors = reference::drawVectors();
  for (const Case& broken : cases) {
    INFO(broken.vector << ": " << broken.from << " -> " << broken.to);
    const TemporaryFolder folder;
    writeVector(folder.path, named(vectors, broken.vector), {});
    std::string json = filesOf(folder.path)["vector.json"];
    const std::size_t place = json.find(broken.from);
    REQUIRE(place != std::string::npos);
    json.replace(place, std::string(broken.from).size(), broken.to);
    std::ofstream(folder.path / "vector.json") << json;
    CHECK_THROWS_AS(reference::readVector(folder.path), raster::InputError);
  }
}
