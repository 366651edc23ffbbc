// A record reads back what was written, and shows every change of its text.
#include "reference/conformance/records/conformance_record.h"

#include <catch2/catch.hpp>
#include <fstream>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/conformance/suite/vector_suite.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using reference::ConformanceRecord;
using reference::RecordFile;

namespace {

reference::TestVector named(const std::string& name) {
  for (const reference::TestVector& vector : reference::vectorSuite())
    if (vector.name == name) return vector;
  throw std::logic_error(name);
}

/// Two vectors, the second with an error at its first pixel.
struct Recorded {
  Recorded() {
    for (const char* name : {"five-faces", "same-triangle"}) {
      const std::filesystem::path vectorFolder = folder.path / name;
      std::filesystem::create_directory(vectorFolder);
      const reference::TestVector vector = named(name);
      std::vector<raster::ItemBuffer> found = reference::render(vector);
      reference::writeVector(vectorFolder, vector, found);
      if (vector.name == "same-triangle") found[0].ids[0] ^= 1;
      record.vectors.push_back(recordOf(reference::reportOn(vector, found, {}), vectorFolder));
    }
    record.vectors[1].expected = {"same-triangle", reference::Expectation::Fail, "a \"reason\""};
    record.device = "a device";
    record.driver = "1.2";
    record.profile.subpixelBits = 4;
    text = toJson(record);
  }

  RecordFile read(const std::string& changed) const {
    std::ofstream(folder.path / "record.json") << changed;
    return reference::readRecord(folder.path / "record.json");
  }

  TemporaryFolder folder;
  ConformanceRecord record;
  std::string text;
};

}  // namespace

TEST_CASE("readRecord returns what toJson wrote", "[records]") {
  const Recorded given;
  const RecordFile file = given.read(given.text);
  CHECK(file.damage.empty());
  CHECK(file.entries == 3);
  CHECK(toJson(file.record) == given.text);
  CHECK(file.record.profile == given.record.profile);
  CHECK(file.record.vectors[1].outcome == reference::Outcome::Errors);
  CHECK(file.record.vectors[1].faces == given.record.vectors[1].faces);
}

TEST_CASE("hashOfVector changes with every byte and name of a vector's files", "[records]") {
  const Recorded given;
  const auto vector = given.folder.path / "same-triangle";
  const std::string before = reference::hashOfVector(vector);
  CHECK(before == given.record.vectors[1].files);
  for (const auto& entry : std::filesystem::directory_iterator(vector)) {
    std::string bytes = raster::readFile(entry.path());
    bytes.back() ^= 1;
    raster::writeFile(entry.path(), bytes);
    CHECK(reference::hashOfVector(vector) != before);
    bytes.back() ^= 1;
    raster::writeFile(entry.path(), bytes);
  }
  std::filesystem::rename(vector / "vector.json", vector / "renamed.json");
  CHECK(reference::hashOfVector(vector) != before);
}

// Whatever byte is changed, of every third one: the file is no longer readable as a record, or its damage is reported,
// or only blanks between the values were changed.
TEST_CASE("readRecord finds the damage of single bytes", "[records]") {
  const Recorded given;
  int found = 0, same = 0;
  for (std::size_t place = 0; place < given.text.size(); place += 3) {
    std::string changed = given.text;
    changed[place] ^= 1;
    try {
      const RecordFile file = given.read(changed);
      if (!file.damage.empty())
        ++found;
      else {
        INFO(changed.substr(place > 40 ? place - 40 : 0, 80));
        CHECK(toJson(file.record) == given.text);
        ++same;
      }
    } catch (const raster::InputError&) {
      ++found;
    }
  }
  CHECK(found > static_cast<int>(given.text.size()) / 6);
  CHECK(same < found / 10);
}

TEST_CASE("readRecord names the damaged entry", "[records]") {
  const Recorded given;
  const auto damageOf = [&](const std::string& from, const std::string& to) {
    std::string text = given.text;
    text.replace(text.find(from), from.size(), to);
    return given.read(text).damage;
  };
  using Lines = std::vector<std::string>;
  CHECK(damageOf("\"a device\"", "\"another\"") == Lines{"the header differs from its hash"});
  CHECK(damageOf("\"errors\"", "\"pass\"") == Lines{"the entry of same-triangle differs from its hash"});
  // A whole entry that is gone leaves all others intact.
  ConformanceRecord fewer = given.record;
  fewer.vectors.pop_back();
  const std::string with = given.text, without = toJson(fewer);
  const std::size_t header = with.find("\"sha256\""), rest = without.find("\"sha256\"");
  const RecordFile file = given.read(with.substr(0, header) + with.substr(header, 76) + without.substr(rest + 76));
  CHECK(file.damage == Lines{"it has entries of 1 vectors instead of 2"});
}

TEST_CASE("differences names the face with other item IDs or verdicts", "[records]") {
  const Recorded given;
  const reference::RecordedVector& recorded = given.record.vectors[1];
  CHECK(differences(recorded, recorded).empty());
  reference::RecordedVector found = recorded;
  found.faces[0].ids[0] ^= 1;
  CHECK(differences(recorded, found).at(0).find("same-triangle, " + found.faces[0].name + ": other item IDs") == 0);
  found = recorded;
  ++found.faces[0].pixels[0];
  CHECK(differences(recorded, found).at(0).find(": another verdict") != std::string::npos);
  found.faces.clear();
  CHECK(differences(recorded, found).empty());
  found.files[0] ^= 1;
  CHECK(differences(recorded, found).at(0).find("same-triangle: other files") == 0);
}
