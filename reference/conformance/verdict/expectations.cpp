#include "reference/conformance/verdict/expectations.h"

#include <algorithm>
#include <sstream>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::reference {
namespace {

using raster::InputError;

constexpr const char* blanks = " \t\r";

Expectation expectationNamed(const std::string& word, const std::string& vector) {
  for (const auto& [expectation, name] : expectationNames)
    if (word == name) return expectation;
  throw InputError(word.empty() ? "\"" + vector + "\" has no expectation" : "\"" + word + "\" is not an expectation",
                   "use fail, unsupported or flaky");
}

/// Throws InputError without the place.
ExpectedResult parseLine(const std::string& line, std::span<const std::string> vectors) {
  ExpectedResult result;
  std::istringstream words(line);
  std::string expectation;
  words >> result.vector >> expectation >> std::ws;
  std::getline(words, result.reason);
  result.reason.erase(result.reason.find_last_not_of(blanks) + 1);
  result.expectation = expectationNamed(expectation, result.vector);
  if (std::find(vectors.begin(), vectors.end(), result.vector) == vectors.end())
    throw InputError("the suite has no vector \"" + result.vector + "\"", "correct the name or remove the line");
  if (result.reason.empty())
    throw InputError("\"" + result.vector + "\" has no reason", "write it at the end of the line");
  return result;
}

bool isComment(const std::string& line) {
  const std::size_t begin = line.find_first_not_of(blanks);
  return begin == std::string::npos || line[begin] == '#';
}

}  // namespace

Expectations readExpectations(const std::filesystem::path& file, std::span<const std::string> vectors) {
  Expectations expectations;
  std::istringstream lines(raster::readFile(file));
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    if (isComment(line)) continue;
    try {
      const ExpectedResult result = parseLine(line, vectors);
      if (!expectations.emplace(result.vector, result).second)
        throw InputError("\"" + result.vector + "\" appears twice", "keep one of its lines");
    } catch (const InputError& error) {
      throw InputError(file.string(), number, error.what());
    }
  }
  return expectations;
}

Agreement compare(Outcome outcome, const std::optional<ExpectedResult>& expected) {
  if (outcome == Outcome::NotJudged) return Agreement::AsExpected;
  if (outcome == Outcome::Missing) return Agreement::UnexpectedFailure;
  if (outcome == Outcome::Pass)
    return expected && expected->expectation == Expectation::Fail ? Agreement::UnexpectedPass : Agreement::AsExpected;
  return expected ? Agreement::AsExpected : Agreement::UnexpectedFailure;
}

std::string toText(const ExpectedResult& expected) {
  const bool isFail = expected.expectation == Expectation::Fail;
  return (isFail ? "expected to fail" : nameOf(expectationNames, expected.expectation)) + ": " + expected.reason;
}

}  // namespace hemitex::reference
