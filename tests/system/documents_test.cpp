/// README.md files, CONTRIBUTING.md, the pages of docs/ and comments: the files that they name exist, and sentences are
/// short.
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "raster/base/file_io.h"

namespace fs = std::filesystem;
using hemitex::raster::readFile;

namespace {

const fs::path top = HEMITEX_SOURCE;

/// Each folder with headers has an overview, and so does each library.
std::vector<fs::path> overviews() {
  std::set<fs::path> found;
  for (const char* library : {"raster", "radiosity", "reference"}) {
    found.insert(top / library / "README.md");
    for (const auto& entry : fs::recursive_directory_iterator(top / library))
      if (entry.path().extension() == ".h") found.insert(entry.path().parent_path() / "README.md");
  }
  return {found.begin(), found.end()};
}

std::vector<fs::path> pages() {
  std::vector<fs::path> found = overviews();
  found.push_back(top / "README.md");
  found.push_back(top / "CONTRIBUTING.md");
  for (const auto& entry : fs::directory_iterator(top / "docs")) {
    if (entry.path().extension() == ".md") found.push_back(entry.path());
  }
  return found;
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), std::sregex_iterator()};
}

/// Paragraphs and list items, each as one line; without headings, tables, code blocks and pictures.
std::vector<std::string> paragraphs(const std::string& page) {
  std::vector<std::string> found(1);
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const bool isProse = !line.empty() && line.find_first_of("#|!") != 0 && !line.starts_with("    ");
    const bool isItem = std::regex_search(line, std::regex(R"(^ *(-|\d+\.) )"));
    if (!isProse || isItem) found.emplace_back();
    if (isProse) found.back() += " " + line;
  }
  return found;
}

/// Sentences end with a period, colon, semicolon, question or exclamation mark before a blank.
std::vector<std::string> sentences(const std::string& paragraph) {
  const std::regex end(R"([.:;?!][)*`"]* +)");
  return {std::sregex_token_iterator(paragraph.begin(), paragraph.end(), end, -1), std::sregex_token_iterator()};
}

std::size_t wordCount(const std::string& sentence) {
  std::istringstream stream(sentence);
  std::size_t count = 0;
  for (std::string word; stream >> word;) count += 1;
  return count;
}

/// Headers and sources of the repository.
std::vector<fs::path> sources() {
  std::vector<fs::path> found;
  for (const char* folder : {"raster", "radiosity", "reference", "cli", "python", "data", "examples", "tests"}) {
    for (const auto& entry : fs::recursive_directory_iterator(top / folder)) {
      if (entry.path().extension() == ".h" || entry.path().extension() == ".cpp") found.push_back(entry.path());
    }
  }
  return found;
}

}  // namespace

TEST_CASE("Headers and sources that comments name exist", "[documents]") {
  const std::vector<fs::path> files = sources();
  std::set<std::string> names;
  for (const fs::path& file : files) names.insert(file.filename().string());
  const std::regex named(R"(\b\w+\.(h|cpp)\b)");
  std::size_t count = 0;
  for (const fs::path& file : files) {
    std::istringstream lines(readFile(file));
    for (std::string line; std::getline(lines, line);) {
      if (line.find("// ") == std::string::npos && line.find("/// ") == std::string::npos) continue;
      if (line.find(".h") == std::string::npos && line.find(".cpp") == std::string::npos) continue;
      const std::string comment = line.substr(line.find("//"));
      for (const std::smatch& match : matches(comment, named)) {
        if (file.filename() == "includes_test.cpp") continue;  // invents names
        INFO(file << ": " << comment);
        CHECK(names.count(match.str()) == 1);
        ++count;
      }
    }
  }
  CHECK(count > 20);
}

TEST_CASE("Each folder of the libraries has an overview, whose headers exist", "[documents]") {
  const std::vector<fs::path> files = overviews();
  CHECK(files.size() > 30);
  for (const fs::path& file : files) {
    INFO(file);
    REQUIRE(fs::exists(file));
    const std::string text = readFile(file);
    CHECK(text.starts_with("# " + fs::relative(file.parent_path(), top).generic_string() + "\n\n"));
    for (const std::smatch& match : matches(text, std::regex(R"(`(\w+\.h)`)"))) {
      INFO(match[1]);
      CHECK(fs::exists(file.parent_path() / match[1].str()));
    }
  }
}

TEST_CASE("Files that README.md and docs name exist", "[documents]") {
  const std::regex inBackticks(R"(`((?:data|docs|raster|radiosity|reference|cli|tests)/[\w/.-]+)`)");
  const std::regex linked(R"(\]\(([^):#]+)(?:#[^)]*)?\))");
  std::size_t count = 0;
  for (const fs::path& page : pages()) {
    const std::string text = readFile(page);
    for (const std::smatch& match : matches(text, inBackticks)) {
      INFO(page.filename() << " names " << match[1]);
      CHECK(fs::exists(top / match[1].str()));
      ++count;
    }
    for (const std::smatch& match : matches(text, linked)) {
      INFO(page.filename() << " links " << match[1]);
      CHECK(fs::exists(page.parent_path() / match[1].str()));
      ++count;
    }
  }
  CHECK(count > 40);
}

TEST_CASE("docs/tutorial.md names functions that their headers declare", "[documents]") {
  const std::string tutorial = readFile(top / "docs/tutorial.md");
  const std::vector<std::smatch> stages = matches(tutorial, std::regex(R"(\| `([\w/]+\.h)` \| `(\w+)` \|)"));
  REQUIRE(stages.size() == 11);
  for (const std::smatch& stage : stages) {
    INFO(stage[1] << " declares " << stage[2]);
    REQUIRE(fs::exists(top / stage[1].str()));
    CHECK(std::regex_search(readFile(top / stage[1].str()), std::regex("\\b" + stage[2].str() + "\\(")));
  }
}

TEST_CASE("Sentences of README.md and docs have at most 25 words", "[documents]") {
  for (const fs::path& page : pages()) {
    for (const std::string& paragraph : paragraphs(readFile(page))) {
      for (const std::string& sentence : sentences(paragraph)) {
        INFO(page.filename() << ": " << sentence);
        CHECK(wordCount(sentence) <= 25);
      }
    }
  }
}
