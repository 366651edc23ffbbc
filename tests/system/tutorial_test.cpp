/// docs/tutorial.md and docs/exercises.md: each command prints what stands on the page, except for times, and draws the
/// picture that the page shows.
#include <catch2/catch.hpp>
#include <sstream>

#include "radiosity/images/image.h"
#include "raster/base/file_io.h"
#include "tests/pages/page_commands.h"
#include "tests/support/temporary_folder.h"

namespace fs = std::filesystem;
using namespace hemitex;
using namespace hemitex::pages;

namespace {

const fs::path docs = HEMITEX_DOCS;

/// Runs the commands of a page in a folder where they find `data` and `docs`.
std::string runPage(const std::string& page, const fs::path& folder) {
  for (const char* name : {"data", "docs"})
    fs::create_directory_symlink(fs::path(HEMITEX_SOURCE) / name, folder / name);
  return withOutputs(page, folder, fs::path(HEMITEX_PROGRAM).parent_path());
}

/// The first line of `found` that differs from `expected`; empty if the texts are equal.
std::string firstDifference(const std::string& found, const std::string& expected) {
  std::istringstream foundLines(found), expectedLines(expected);
  for (std::string line, other; std::getline(foundLines, line);) {
    if (!std::getline(expectedLines, other) || line != other) return line;
  }
  return found == expected ? "" : "the end of the page";
}

void checkPage(const std::string& name) {
  INFO("to write the page and its pictures again: cmake --build build/release --target pages");
  const std::string page = raster::readFile(docs / name);
  const TemporaryFolder folder;
  CHECK(firstDifference(withoutTimes(runPage(page, folder.path)), withoutTimes(page)) == "");
  for (const std::string& picture : picturesOf(page)) {
    INFO(picture);
    const radiosity::Image drawn = radiosity::readImage(folder.path / "out" / picture);
    const radiosity::Image shown = radiosity::readImage(docs / picture);
    CHECK(drawn.width == shown.width);
    CHECK(drawn.height == shown.height);
    const bool pixelsAreEqual = drawn.pixels == shown.pixels;
    CHECK(pixelsAreEqual);
  }
}

}  // namespace

TEST_CASE("withOutputs runs the commands of a page and replaces what they printed", "[documents]") {
  const TemporaryFolder folder;
  const std::string page =
      "text\n\n    no command\n\n    $ echo one; echo; echo two >&2\n    old\n    $ for i in 3 4; do\n    >   echo $i\n"
      "    > done\n    old\n    older\n\n    $ exit 7\n";
  CHECK(withOutputs(page, folder.path, folder.path) ==
        "text\n\n    no command\n\n    $ echo one; echo; echo two >&2\n    one\n    two\n    $ for i in 3 4; do\n"
        "    >   echo $i\n    > done\n    3\n    4\n\n    $ exit 7\n    (exit code 7)\n");
}

TEST_CASE("withoutTimes hides seconds and keeps other numbers", "[documents]") {
  CHECK(withoutTimes("5 shots in 0.03 s, 16 surfaces, 1e-05 s, 2 sums, 3.5 %") ==
        "5 shots in # s, 16 surfaces, # s, 2 sums, 3.5 %");
}

TEST_CASE("picturesOf finds the PNG files of a page", "[documents]") {
  CHECK(picturesOf("![a](tutorial/a.png) [b](b.md) | ![c d](c.png)") ==
        std::vector<std::string>{"tutorial/a.png", "c.png"});
}

TEST_CASE("The commands of docs/tutorial.md print and draw what the page shows", "[documents]") {
  checkPage("tutorial.md");
}

TEST_CASE("The exercises of docs/exercises.md fail at their starts as the page says", "[documents]") {
  const std::string page = raster::readFile(docs / "exercises.md");
  checkPage("exercises.md");
  std::size_t failures = 0;
  for (std::size_t at = 0; (at = page.find("    (exit code 1)\n", at)) != std::string::npos; ++at) failures += 1;
  CHECK(failures == 10);
}

TEST_CASE("The check of a solved exercise says that it passed", "[documents]") {
  const TemporaryFolder folder;
  fs::copy(docs / "exercises", folder.path / "exercises", fs::copy_options::recursive);
  // Two opposing unit squares at distance 1 (Howell, factor C-11): 2/π (ln √(4/3) + √2 atan(√2 / 2) 2 - π/2).
  raster::writeFile(folder.path / "exercises/03-opposing-squares/form_factor.py",
                    "from math import atan, log, pi, sqrt\n"
                    "print(2 / pi * (log(sqrt(4 / 3)) + 2 * sqrt(2) * atan(1 / sqrt(2)) - pi / 2))\n");
  const std::string page = withOutputs("    $ sh exercises/03-opposing-squares/check.sh\n", folder.path,
                                       fs::path(HEMITEX_PROGRAM).parent_path());
  CHECK(page ==
        "    $ sh exercises/03-opposing-squares/check.sh\n"
        "    form factor 0.1998, error 0.00 % (goal: below 0.2 %)\n"
        "    passed\n");
}
