// The programs of examples/ run as their comments say, and the documentation quotes what stands in them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <iterator>
#include <regex>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "raster/base/file_io.h"
#include "tests/support/shell.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;

namespace {

/// The words of a text: blocks of a page are indented differently from the program.
std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// A passage that a page quotes: the block after a line that ends with a colon, in a paragraph that links to the file.
struct Quotation {
  std::string file;  ///< in examples/
  std::string text;
};

std::vector<Quotation> quotationsOf(const fs::path& page) {
  std::vector<Quotation> quotations;
  std::istringstream lines(hemitex::raster::readFile(page));
  std::string paragraph;
  const std::regex link(R"(examples/(\w+\.cpp)\))");
  bool isQuoted = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("    ") || (line.empty() && isQuoted)) {
      if (isQuoted) quotations.back().text += line + '\n';
      continue;
    }
    if (std::exchange(isQuoted, false)) paragraph.clear();
    if (!line.empty()) {
      paragraph += line + '\n';
      std::smatch found;
      if ((line.ends_with(':') || line.ends_with(":")) && std::regex_search(paragraph, found, link)) {
        std::string last;
        for (std::sregex_iterator i(paragraph.begin(), paragraph.end(), link), end; i != end; ++i) last = (*i)[1];
        quotations.push_back({last, ""});
        isQuoted = true;
      }
    } else {
      paragraph.clear();
    }
  }
  return quotations;
}

class Examples : public Shell {
 public:
  Outcome example(const std::string& command) const { return execute(HEMITEX_EXAMPLES "/hemitex_" + command); }
};

}  // namespace

TEST_CASE("README, the tutorial and the page of backends quote passages of examples", "[examples]") {
  const fs::path top = HEMITEX_SOURCE;
  const std::vector<std::pair<std::string, std::size_t>> pages{
      {"README.md", 1}, {"docs/backend.md", 2}, {"docs/tutorial.md", 3}};
  for (const auto& [page, count] : pages) {
    const std::vector<Quotation> quotations = quotationsOf(top / page);
    CHECK(quotations.size() == count);
    for (const Quotation& quotation : quotations) {
      INFO(page << " quotes " << quotation.file << ":\n" << quotation.text);
      const std::vector<std::string> program = wordsOf(hemitex::raster::readFile(top / "examples" / quotation.file));
      const std::vector<std::string> quoted = wordsOf(quotation.text);
      CHECK(quoted.size() > 20);
      CHECK(std::search(program.begin(), program.end(), quoted.begin(), quoted.end()) != program.end());
    }
  }
}

TEST_CASE("The example own_backend names the fault of its first attempt", "[examples]") {
  const Outcome outcome = Examples().example("own_backend");
  CHECK(outcome.exitCode == 0);
  CHECK_THAT(outcome.out, Catch::Contains("wrong item IDs; affine instead of perspective interpolation"));
  CHECK_THAT(outcome.out, Catch::EndsWith("perspective-floor: no errors\n"));
}

TEST_CASE("The example compute_rasterizer names the holes of its first version", "[examples]") {
  const Outcome outcome = Examples().example("compute_rasterizer");
  CHECK(outcome.exitCode == 0);
  CHECK_THAT(outcome.out, Catch::Contains("fans-later-nearer: wrong fill rule, no edge"));
  CHECK_THAT(outcome.out, Catch::EndsWith("fans-later-nearer: no errors\n"));
}

// The eye looks at a triangle that is 2 wide and high at a depth of 2: half of 16 pixels. Its left half shows the
// texels of column 0, items 4 and 6.
TEST_CASE("The example draw_item_buffer prints a triangle of four elements", "[examples]") {
  const Outcome outcome = Examples().example("draw_item_buffer");
  CHECK(outcome.exitCode == 0);
  std::istringstream lines(outcome.out);
  int covered = 0, rows = 0;
  for (std::string line; std::getline(lines, line); ++rows) {
    const std::vector<std::string> pixels = wordsOf(line);
    REQUIRE(pixels.size() == 16);
    for (std::size_t column = 0; column < 16; ++column) {
      if (pixels[column] == ".") continue;
      ++covered;
      CHECK((pixels[column] == "4" || pixels[column] == "6") == (column < 8));
    }
  }
  CHECK(rows == 16);
  CHECK(covered == 32);  // half of 8 x 8 pixels
}

TEST_CASE("The example light_a_room writes a picture", "[examples]") {
  const Examples shell;
  const Outcome outcome = shell.example("light_a_room room.png");
  CHECK(outcome.exitCode == 0);
  CHECK_THAT(outcome.out, Catch::Contains("wall-right: "));
  CHECK(fs::file_size(shell.file("room.png")) > 10000);
}
