/// `hemitex vector random` as a script uses it.
#include <sys/wait.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "raster/base/file_io.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/vectors/vector_file.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;

namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Outcome {
  int exitCode;
  std::string out, err;
};

Outcome run(const TemporaryFolder& folder, const std::string& arguments) {
  const std::string line = "cd '" + folder.path.string() + "' && '" HEMITEX_PROGRAM "' " + arguments + " >out 2>err";
  const int status = std::system(line.c_str());
  REQUIRE(WIFEXITED(status));
  return {WEXITSTATUS(status), raster::readFile(folder.path / "out"), raster::readFile(folder.path / "err")};
}

/// All files below a folder, with their content.
std::map<std::string, std::string> filesBelow(const fs::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files[fs::relative(entry.path(), folder).string()] = raster::readFile(entry.path());
  return files;
}

}  // namespace

TEST_CASE("hemitex vector random writes vectors of all families that pass hemitex vector check", "[cli]") {
  const TemporaryFolder folder;
  const std::size_t families = reference::randomFamilies().size();
  const std::string count = std::to_string(2 * families);
  const Outcome outcome = run(folder, "vector random --seed 7 --count " + count + " -o made --json");
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
    const fs::path written = folder.path / "made" / expected.name;
    const std::vector<raster::ItemBuffer> ids = reference::readCandidate(written, reference::readVector(written));
    CHECK(reference::idsHash(ids) == reference::idsHash(buffers));
  }
  CHECK(run(folder, "vector check made --candidate made --exact").exitCode == 0);
}

TEST_CASE("hemitex vector random writes the same bytes again, and one family with ascending seeds", "[cli]") {
  const TemporaryFolder folder;
  const std::string command = "vector random --seed 40 --count 3 --family slivers -o ";
  const Outcome first = run(folder, command + "first");
  REQUIRE(first.exitCode == 0);
  CHECK(first.out.substr(0, 18) == "name,catches,hash\n");
  REQUIRE(run(folder, "--threads 1 " + command + "second").exitCode == 0);
  const auto files = filesBelow(folder.path / "first");
  CHECK(files == filesBelow(folder.path / "second"));
  for (const char* name : {"slivers-40", "slivers-41", "slivers-42"})
    CHECK(files.count(name + std::string("/vector.json")) == 1);
}

TEST_CASE("hemitex vector checks, renders and explains random vectors of version 2", "[cli]") {
  for (const reference::RandomFamily& family : reference::newRandomFamilies()) {
    const TemporaryFolder folder;
    const std::string name = family.name, first = "made/" + name + (name == "clip-space" ? "-5" : "-3");
    INFO(name);
    REQUIRE(run(folder, "vector random --seed 3 --count 5 --family " + name + " -o made").exitCode == 0);
    const Outcome check = run(folder, "vector check made --candidate made --exact");
    INFO(check.out << check.err);
    CHECK(check.exitCode == 0);
    CHECK(run(folder, "vector render " + first + " --stages -o drawn").exitCode == 0);
    const reference::TestVector vector = reference::readVector(folder.path / first);
    CHECK(raster::readFile(folder.path / first / "vector.json").find("\"rules\": 2") != std::string::npos);
    const fs::path ids = vector.faces[0].ids;
    CHECK(raster::readFile(folder.path / "drawn" / ids) == raster::readFile(folder.path / first / ids));
    const std::vector<raster::ItemId> shown = reference::render(vector)[0].ids;
    const auto covered = std::find_if(
        shown.begin(), shown.end(), [&](raster::ItemId id) { return id != raster::backgroundId(vector.list.format); });
    REQUIRE(covered != shown.end());
    const auto index = static_cast<std::size_t>(covered - shown.begin());
    const glm::ivec2 at = reference::pixelAt(vector.faces[0].face.scissor, index);
    const std::string pixel = std::to_string(at.x) + "," + std::to_string(at.y);
    const Outcome explained =
        run(folder, "vector explain " + first + " --json --pixel " + vector.faces[0].name + "," + pixel);
    INFO(explained.err);
    REQUIRE(explained.exitCode == 0);
    CHECK(json::parse(explained.out)["word"] == *covered);
  }
}

TEST_CASE("hemitex vector random refuses unknown families and missing options, and writes nothing", "[cli]") {
  const TemporaryFolder folder;
  const Outcome unknown = run(folder, "vector random --seed 1 --count 2 --family splinters -o made");
  CHECK(unknown.exitCode == 2);
  CHECK(unknown.err.find("\"splinters\"") != std::string::npos);
  for (const reference::RandomFamily& family : reference::randomFamilies())
    CHECK(unknown.err.find(family.name) != std::string::npos);
  for (const char* arguments :
       {"--count 2", "--seed 1", "--seed -1 --count 2", "--seed 1 --count 0", "--seed x --count 2"})
    CHECK(run(folder, "vector random -o made " + std::string(arguments)).exitCode == 2);
  CHECK_FALSE(fs::exists(folder.path / "made"));
}
