/// docs/options.md names the options that exclude each other.
#include <catch2/catch.hpp>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include "raster/base/file_io.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::tests;

namespace {

/// Two options, in the order of their names.
using Pairs = std::set<std::set<std::string>>;

std::vector<std::string> optionsIn(const std::string& text) {
  static const std::regex option("--[a-z][a-z-]*");
  std::vector<std::string> found;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), option); at != std::sregex_iterator(); ++at)
    found.push_back(at->str());
  return found;
}

Pairs pairsInHelp(const std::string& help) {
  Pairs pairs;
  std::istringstream lines(help);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find("Excludes:");
    if (at == std::string::npos) continue;
    std::string others = line.substr(at);  // the description follows after two spaces, or on the next line
    const std::string option = optionsIn(line).front();
    static const std::regex list("^Excludes:( --[a-z-]+)*");
    std::smatch match;
    REQUIRE(std::regex_search(others, match, list));
    for (const std::string& other : optionsIn(match.str())) pairs.insert({option, other});
  }
  return pairs;
}

Pairs pairsInPage(const std::string& page) {
  Pairs pairs;
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("| `--")) continue;
    const std::size_t end = line.rfind('|', line.size() - 2);
    const std::vector<std::string> options = optionsIn(line.substr(0, end));
    for (std::size_t i = 1; i < options.size(); ++i) CHECK(pairs.insert({options[0], options[i]}).second);
  }
  return pairs;
}

}  // namespace

TEST_CASE("docs/options.md names each pair of options that hemitex solve refuses", "[cli]") {
  const Shell shell;
  const Pairs help = pairsInHelp(shell.output("solve --help-all"));
  CHECK(help.size() > 10);
  CHECK(help.size() <= 16);
  CHECK(pairsInPage(raster::readFile(HEMITEX_DOCS "/options.md")) == help);
}
