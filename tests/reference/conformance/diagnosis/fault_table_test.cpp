// Each known fault is found and named in one small vector, and docs/faults.md lists it.
#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <map>
#include <optional>
#include <set>
#include <sstream>

#include "reference/conformance/diagnosis/diagnosis.h"
#include "reference/conformance/diagnosis/fault.h"
#include "reference/conformance/scenes/scene_vectors.h"
#include "reference/conformance/suite/vector_suite.h"
#include "tests/support/injected_faults.h"

using namespace hemitex;
using reference::TestVector;

namespace {

/// The parts of a vector with at most 64 pixels: one face, or two neighbours, and in them a window at the same place.
std::vector<TestVector> smallParts(const TestVector& vector) {
  std::vector<TestVector> parts;
  for (const std::size_t faces : {1u, 2u})
    for (std::size_t f = 0; f + faces <= vector.faces.size(); ++f) {
      const raster::Scissor& whole = vector.faces[f].face.scissor;
      for (int row = 0; row < whole.height; row += 8)
        for (int column = 0; column < whole.width; column += 8) {
          TestVector part = vector;
          part.faces.assign(vector.faces.begin() + static_cast<std::ptrdiff_t>(f),
                            vector.faces.begin() + static_cast<std::ptrdiff_t>(f + faces));
          for (reference::VectorFace& face : part.faces) {
            raster::Scissor& scissor = face.face.scissor;
            const int left = std::min(column, scissor.width - 1), top = std::min(row, scissor.height - 1);
            scissor.width = std::min(8, scissor.width - left);
            scissor.height = std::min(8 / static_cast<int>(faces), scissor.height - top);
            scissor.column += left;
            scissor.row += top;
          }
          parts.push_back(part);
        }
    }
  return parts;
}

std::set<std::string> namesOn(const tests::Injection& injection, const TestVector& vector) {
  const tests::Buffers found = injection.draw(vector, tests::SimulatedDevice{.profile = injection.profile});
  std::set<std::string> names;
  for (std::size_t f = 0; f < found.size(); ++f) {
    const raster::Scissor& scissor = vector.faces[f].face.scissor;
    if (found[f].ids.size() != static_cast<std::size_t>(scissor.width * scissor.height)) return names;
  }
  for (const reference::Finding& finding : diagnose(vector, judge(vector, found, injection.profile)))
    names.insert(finding.fault);
  return names;
}

/// The first small part in which the fault alone is named.
std::optional<TestVector> partThatNames(const tests::Injection& injection, const TestVector& vector) {
  for (const TestVector& part : smallParts(vector))
    if (namesOn(injection, part) == std::set{injection.fault}) return part;
  return {};
}

std::set<std::string> allFaults() {
  std::set<std::string> names{"fog", "stale frame"};  // which follow from what was drawn
  for (const TestVector& vector : reference::vectorSuite())
    if (vector.name == "layout-r8g8b8a8" || vector.name == "integer-add-32")
      for (const reference::Fault& fault : knownFaults(vector)) names.insert(fault.name);
  return names;
}

}  // namespace

TEST_CASE("diagnose names each known fault in one vector of at most 8 x 8 pixels", "[diagnosis]") {
  std::map<std::string, TestVector> suite;
  for (const auto& vectors : {reference::vectorSuite(), reference::sceneVectors(HEMITEX_DATA)})
    for (const TestVector& vector : vectors) suite.emplace(vector.name, vector);
  // Where several faults look alike on the vector of an injection.
  const std::array others{"many-maps",         "layout-r5g6b5",
                          "shared-vertices",   "micro-grid-later-nearer",
                          "five-faces-tilted", "sample-grid-later-nearer",
                          "unique-maps",       "perspective-sheet",
                          "magnified"};
  std::map<std::string, std::string> places;  // by fault
  std::set<std::string> injected;
  for (const tests::Injection& injection : tests::injectedFaults()) {
    injected.insert(injection.fault);
    if (places.contains(injection.fault) || !suite.contains(injection.vector)) continue;
    std::vector<const TestVector*> vectors{&suite.at(injection.vector)};
    for (const char* other : others) vectors.push_back(&suite.at(other));
    for (const TestVector* vector : vectors)
      if (!places.contains(injection.fault) && partThatNames(injection, *vector))
        places[injection.fault] = vector->name;
  }
  std::ifstream page(HEMITEX_DOCS "/faults.md");
  std::map<std::string, std::string> lines;  // by fault
  for (std::string line; std::getline(page, line);)
    if (line.starts_with("| ")) lines[line.substr(2, line.find(" |") - 2)] = line;
  // In so few pixels these look like other faults.
  const std::set<std::string> large{"carry across channels",     "faces swapped",     "item ID 0 taken for nothing",
                                    "small triangles not drawn", "triangles missing", "tiled memory read as rows",
                                    "wrap instead of clamp"};
  for (const std::string& fault : injected) {
    INFO(fault);
    CHECK(places.contains(fault) != large.contains(fault));
    const std::string place = places.contains(fault) ? "`" + places[fault] + "`" : "more than 64 pixels";
    UNSCOPED_INFO("docs/faults.md should say | " << place << " |");
    CHECK(lines[fault].ends_with("| " + place + " |"));
  }
}

TEST_CASE("knownFaults has at least 80 faults, and docs/faults.md lists all of them", "[diagnosis]") {
  const std::set<std::string> faults = allFaults();
  CHECK(faults.size() >= 80);
  std::ifstream file(HEMITEX_DOCS "/faults.md");
  std::stringstream page;
  page << file.rdbuf();
  for (const std::string& fault : faults) {
    INFO(fault);
    CHECK(page.str().find("| " + fault + " |") != std::string::npos);
  }
}
