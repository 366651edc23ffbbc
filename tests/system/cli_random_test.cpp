/// `hemitex vector random` as a script uses it.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "raster/base/file_io.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/shell.h"

using namespace hemitex;

namespace fs = std::filesystem;
using nlohmann::json;
using tests::Outcome;
using tests::Shell;

TEST_CASE("hemitex vector random writes vectors of all families that pass hemitex vector check", "[cli]") {
  const Shell shell;
  const std::size_t families = reference::randomFamilies().size();
  const std::string count = std::to_string(2 * families);
  const Outcome outcome = shell.run("vector random --seed 7 --count " + count + " -o made --json");
  INFO(outcome.err);
  REQUIRE(outcome.exitCode == 0);
  const json vectors = json::parse(outcome.out)["vectors"];
  REQUIRE(vectors.size() == 2 * families);
  for (std::size_t k = 0; k < vectors.size(); ++k) {
    const reference::TestVector expected = reference::interleavedRandomVector(7, k);
    const std::vector<raster::ItemBuffer> buffers = reference::render(expected);
    CHECK(vectors[k]["name"] == expected.name);
    CHECK(vectors[k]["catches"] == expected.catches);
    CHECK(vectors[k]["hash"] == reference::idsHash(buffers));
    const fs::path written = shell.file("made") / expected.name;
    const std::vector<raster::ItemBuffer> ids = reference::readCandidate(written, reference::readVector(written));
    CHECK(reference::idsHash(ids) == reference::idsHash(buffers));
  }
  CHECK(shell.run("vector check made --candidate made --exact").exitCode == 0);
}

TEST_CASE("hemitex vector random writes the same bytes again, and one family with ascending seeds", "[cli]") {
  const Shell shell;
  const std::string command = "vector random --seed 40 --count 3 --family slivers -o ";
  const Outcome first = shell.run(command + "first");
  REQUIRE(first.exitCode == 0);
  CHECK(first.out.substr(0, 18) == "name,catches,hash\n");
  REQUIRE(shell.run("--threads 1 " + command + "second").exitCode == 0);
  CHECK(shell.execute("diff -r first second").exitCode == 0);
  for (const char* name : {"slivers-40", "slivers-41", "slivers-42"})
    CHECK(fs::exists(shell.file("first") / name / "vector.json"));
}

TEST_CASE("hemitex vector checks, renders and explains random vectors of version 2", "[cli]") {
  for (const reference::RandomFamily& family : reference::newRandomFamilies()) {
    const Shell shell;
    const std::string name = family.name, first = "made/" + name + (name == "clip-space" ? "-5" : "-3");
    INFO(name);
    REQUIRE(shell.run("vector random --seed 3 --count 5 --family " + name + " -o made").exitCode == 0);
    const Outcome check = shell.run("vector check made --candidate made --exact");
    INFO(check.out << check.err);
    CHECK(check.exitCode == 0);
    CHECK(shell.run("vector render " + first + " --stages -o drawn").exitCode == 0);
    const reference::TestVector vector = reference::readVector(shell.file(first));
    CHECK(raster::readFile(shell.file(first) / "vector.json").find("\"rules\": 2") != std::string::npos);
    const fs::path ids = vector.faces[0].ids;
    CHECK(raster::readFile(shell.file("drawn") / ids) == raster::readFile(shell.file(first) / ids));
    const std::vector<raster::ItemId> shown = reference::render(vector)[0].ids;
    const auto covered = std::find_if(
        shown.begin(), shown.end(), [&](raster::ItemId id) { return id != raster::backgroundId(vector.list.format); });
    REQUIRE(covered != shown.end());
    const auto index = static_cast<std::size_t>(covered - shown.begin());
    const glm::ivec2 at = reference::pixelAt(vector.faces[0].face.scissor, index);
    const std::string pixel = std::to_string(at.x) + "," + std::to_string(at.y);
    const Outcome explained =
        shell.run("vector explain " + first + " --json --pixel " + vector.faces[0].name + "," + pixel);
    INFO(explained.err);
    REQUIRE(explained.exitCode == 0);
    CHECK(json::parse(explained.out)["word"] == *covered);
  }
}

TEST_CASE("hemitex vector random refuses unknown families and missing options, and writes nothing", "[cli]") {
  const Shell shell;
  const Outcome unknown = shell.run("vector random --seed 1 --count 2 --family splinters -o made");
  CHECK(unknown.exitCode == 2);
  CHECK(unknown.err.find("\"splinters\"") != std::string::npos);
  for (const reference::RandomFamily& family : reference::randomFamilies())
    CHECK(unknown.err.find(family.name) != std::string::npos);
  for (const char* arguments :
       {"--count 2", "--seed 1", "--seed -1 --count 2", "--seed 1 --count 0", "--seed x --count 2"})
    CHECK(shell.run("vector random -o made " + std::string(arguments)).exitCode == 2);
  CHECK_FALSE(fs::exists(shell.file("made")));
}
