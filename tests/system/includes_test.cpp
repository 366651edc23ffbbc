/// The layout that CONTRIBUTING.md promises. Includes go down the list of top folders (cli, web, python; reference;
/// radiosity; raster), front ends never include each other, and neither units nor folders include each other in a
/// cycle. A folder has at most 15 units, and tests lie in the same tree as what they test.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace fs = std::filesystem;

namespace {

struct Include {
  std::string file;  ///< relative to the top folder, like the included path
  std::size_t line = 0;
  std::string included;

  std::string text() const { return file + ":" + std::to_string(line) + ": #include \"" + included + "\""; }
};

/// The key is a unit: a header and its source.
using Graph = std::map<std::string, std::vector<Include>>;

const std::vector<std::string> rooms = {"raster", "radiosity", "reference", "cli", "web", "python"};

bool isSource(const fs::path& file) { return file.extension() == ".h" || file.extension() == ".cpp"; }

std::vector<Include> includesOf(const std::string& file, std::istream& lines) {
  std::vector<Include> includes;
  std::size_t number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const std::string start = "#include \"";
    if (!line.starts_with(start)) continue;
    includes.push_back({file, number, line.substr(start.size(), line.find('"', start.size()) - start.size())});
  }
  return includes;
}

/// The includes of all sources in the top folders; of headers only if `isHeaderOnly`.
std::vector<Include> includesOfRooms() {
  std::vector<Include> includes;
  for (const std::string& room : rooms) {
    const fs::path folder = fs::path(HEMITEX_SOURCE) / room;
    if (!fs::exists(folder)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
      if (!isSource(entry.path())) continue;
      std::ifstream lines(entry.path());
      const std::string name = fs::relative(entry.path(), HEMITEX_SOURCE).generic_string();
      const std::vector<Include> found = includesOf(name, lines);
      includes.insert(includes.end(), found.begin(), found.end());
    }
  }
  return includes;
}

/// The rank of a file's top folder. An include may go to the same or a lower rank; front ends have equal ranks.
std::size_t roomOf(const std::string& file) {
  const std::string room = file.substr(0, file.find('/'));
  return static_cast<std::size_t>(std::find(rooms.begin(), rooms.end(), room) - rooms.begin());
}

bool goesUp(const Include& include) {
  const std::size_t from = roomOf(include.file);
  const std::size_t to = roomOf(include.included);
  const std::size_t frontEnds = roomOf("cli/");
  return to > from || (from >= frontEnds && to >= frontEnds && from != to);
}

std::string withoutExtension(const std::string& file) { return file.substr(0, file.rfind('.')); }

std::string folderOf(const std::string& file) { return fs::path(file).parent_path().generic_string(); }

/// The node of a file in a graph: its unit (a header with its source) or its folder.
using NodeOf = std::string (*)(const std::string& file);

/// The includes along one cycle of nodes, if there is one.
std::vector<Include> circle(const std::vector<Include>& includes, NodeOf nodeOf = withoutExtension) {
  Graph graph;
  for (const Include& include : includes) {
    if (nodeOf(include.included) != nodeOf(include.file)) graph[nodeOf(include.file)].push_back(include);
  }
  enum class State { New, Open, Done };
  std::map<std::string, State> states;
  std::vector<Include> path;
  const auto visit = [&](const auto& self, const std::string& unit) -> bool {
    states[unit] = State::Open;
    for (const Include& include : graph[unit]) {
      const std::string next = nodeOf(include.included);
      path.push_back(include);
      if (states[next] == State::Open) {
        while (nodeOf(path.front().file) != next) path.erase(path.begin());
        return true;
      }
      if (states[next] == State::New && self(self, next)) return true;
      path.pop_back();
    }
    states[unit] = State::Done;
    return false;
  };
  for (const auto& unit : std::vector(graph.begin(), graph.end())) {
    if (states[unit.first] == State::New && visit(visit, unit.first)) return path;
  }
  return {};
}

std::string textOf(const std::vector<Include>& includes) {
  std::string text;
  for (const Include& include : includes) text += "\n" + include.text();
  return text;
}

}  // namespace

TEST_CASE("goesUp and circle find wrong includes", "[includes]") {
  CHECK(goesUp({"raster/a.h", 1, "radiosity/b.h"}));
  CHECK(goesUp({"radiosity/a.h", 1, "cli/b.h"}));
  CHECK(goesUp({"cli/a.h", 1, "python/b.h"}));
  CHECK_FALSE(goesUp({"cli/a.h", 1, "raster/b.h"}));
  CHECK_FALSE(goesUp({"cli/a.h", 1, "cli/b.h"}));

  const Include up{"raster/a.cpp", 3, "raster/b.h"};
  const Include down{"raster/b.h", 7, "raster/c.h"};
  const Include back{"raster/c.cpp", 9, "raster/a.h"};
  CHECK(circle({up, down, {"raster/a.cpp", 1, "raster/a.h"}}).empty());
  // A source belongs to the unit of its header: c.cpp closes the cycle that a.cpp and b.h begin.
  CHECK(textOf(circle({up, down, back})) ==
        "\nraster/a.cpp:3: #include \"raster/b.h\"\nraster/b.h:7: #include \"raster/c.h\""
        "\nraster/c.cpp:9: #include \"raster/a.h\"");
}

TEST_CASE("includesOfRooms go to lower folders only, and form no cycle", "[includes]") {
  const std::vector<Include> includes = includesOfRooms();
  REQUIRE(includes.size() > 1000);
  std::vector<Include> upward;
  for (const Include& include : includes) {
    if (goesUp(include)) upward.push_back(include);
  }
  INFO("these includes go up:" << textOf(upward));
  CHECK(upward.empty());
  const std::vector<Include> found = circle(includes);
  INFO("these units include each other in a circle:" << textOf(found));
  CHECK(found.empty());
}

TEST_CASE("circle finds folders that include each other without a cycle of units", "[includes]") {
  const std::vector<Include> includes{{"raster/one/a.cpp", 1, "raster/two/b.h"},
                                      {"raster/two/c.cpp", 2, "raster/one/d.h"}};
  CHECK(circle(includes).empty());
  CHECK(circle(includes, folderOf).size() == 2);
}

TEST_CASE("includesOfRooms form no cycle of folders", "[includes]") {
  const std::vector<Include> found = circle(includesOfRooms(), folderOf);
  INFO("these folders include each other in a circle:" << textOf(found));
  CHECK(found.empty());
}

TEST_CASE("unitsOf: a folder has at most 15 units", "[includes]") {
  std::map<std::string, std::set<std::string>> unitsOf;
  for (const std::string& room : rooms) {
    const fs::path top = fs::path(HEMITEX_SOURCE) / room;
    if (!fs::exists(top)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
      if (!isSource(entry.path())) continue;
      const std::string name = fs::relative(entry.path(), HEMITEX_SOURCE).generic_string();
      unitsOf[folderOf(name)].insert(withoutExtension(name));
    }
  }
  CHECK(unitsOf.size() > 40);
  for (const auto& [folder, units] : unitsOf) {
    INFO(folder);
    CHECK(units.size() <= 15);
  }
}

TEST_CASE("Tests of raster, radiosity and reference lie in the tree of what they test", "[includes]") {
  const fs::path top = HEMITEX_SOURCE;
  std::size_t folders = 0;
  for (const char* room : {"raster", "radiosity", "reference", "examples"}) {
    for (const auto& entry : fs::recursive_directory_iterator(top / "tests" / room)) {
      if (!entry.is_directory()) continue;
      const fs::path tested = fs::relative(entry.path(), top / "tests");
      INFO(tested);
      CHECK(fs::is_directory(top / tested));
      ++folders;
    }
  }
  CHECK(folders > 30);
}
