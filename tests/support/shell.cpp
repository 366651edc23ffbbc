#include "tests/support/shell.h"

#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>

namespace hemitex::tests {
namespace {

namespace fs = std::filesystem;

/// A closed cube of side 2 about the origin, seen from inside, one face of which emits.
constexpr const char* room = R"(mtllib room.mtl
v -1 -1 -1
v 1 -1 -1
v 1 1 -1
v -1 1 -1
v -1 -1 1
v 1 -1 1
v 1 1 1
v -1 1 1
usemtl white
g floor
f 1 4 8 5
g left
f 1 5 6 2
g right, with "quotes"
f 4 3 7 8
g back:1,2
f 1 2 3 4
g front
f 5 8 7 6
usemtl lamp
g ceiling/lamp
f 2 6 7 3
)";
constexpr const char* roomMaterials = R"(newmtl white
Kd 0.7 0.5 0.3
newmtl lamp
Kd 0 0 0
Ke 10 10 10
)";

}  // namespace

std::string readAll(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  REQUIRE(stream);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void writeAll(const fs::path& file, const std::string& text) { std::ofstream(file, std::ios::binary) << text; }

Shell::Shell() {
  writeAll(file("room.obj"), room);
  writeAll(file("room.mtl"), roomMaterials);
}

Outcome Shell::run(const std::string& arguments) const { return execute("'" HEMITEX_PROGRAM "' " + arguments); }

Outcome Shell::execute(const std::string& line) const {
  const fs::path out = streams_.path / "out", err = streams_.path / "err";
  const std::string all =
      "cd '" + folder_.path.string() + "' && { " + line + "\n} >'" + out.string() + "' 2>'" + err.string() + "'";
  const int status = std::system(all.c_str());
  REQUIRE(WIFEXITED(status));
  return {WEXITSTATUS(status), readAll(out), readAll(err)};
}

std::string Shell::output(const std::string& arguments) const {
  const Outcome outcome = run(arguments);
  INFO(arguments << '\n' << outcome.err);
  REQUIRE(outcome.exitCode == 0);
  return outcome.out;
}

std::map<std::string, std::string> Shell::files() const {
  std::map<std::string, std::string> contents;
  for (const auto& entry : fs::recursive_directory_iterator(folder_.path))
    contents[fs::relative(entry.path(), folder_.path).string()] =
        entry.is_regular_file() ? readAll(entry.path()) : "a folder";
  return contents;
}

std::vector<std::string> linesOf(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

double lastNumber(const std::string& line) { return std::stod(line.substr(line.rfind(',') + 1)); }

}  // namespace hemitex::tests
