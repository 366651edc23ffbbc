// The file of expected results, and outcomes compared with it.
#include "reference/conformance/verdict/expectations.h"

#include <catch2/catch.hpp>
#include <fstream>
#include <vector>

#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using reference::Agreement;
using reference::Expectation;
using reference::ExpectedResult;
using reference::Outcome;

namespace {

const std::vector<std::string> suite{"near", "far", "carry"};

reference::Expectations readText(const std::string& text) {
  const TemporaryFolder folder;
  std::ofstream(folder.path / "known.txt") << text;
  return reference::readExpectations(folder.path / "known.txt", suite);
}

}  // namespace

TEST_CASE("readExpectations reads names, words and reasons between comments", "[verdict]") {
  const reference::Expectations expectations = readText(
      "# the driver of 2019\n\nnear fail  rounds down, bug 12 \r\n  # indented\n\tcarry\tunsupported\tno carry\n");
  REQUIRE(expectations.size() == 2);
  CHECK(expectations.at("near").expectation == Expectation::Fail);
  CHECK(expectations.at("near").reason == "rounds down, bug 12");
  CHECK(expectations.at("carry").expectation == Expectation::Unsupported);
  CHECK(toText(expectations.at("near")) == "expected to fail: rounds down, bug 12");
  CHECK(toText(expectations.at("carry")) == "unsupported: no carry");
  CHECK(readText("far flaky now and then").at("far").expectation == Expectation::Flaky);
  CHECK(readText("").empty());
}

TEST_CASE("readExpectations names file, line and fault", "[verdict]") {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"near fail x\nfar broken y", "known.txt:2: \"broken\" is not an expectation"},
      {"\n\nnorth fail x", "known.txt:3: the suite has no vector \"north\""},
      {"near fail x\n\nnear flaky y", "known.txt:3: \"near\" appears twice"},
      {"near fail  ", "known.txt:1: \"near\" has no reason"},
      {"near", "known.txt:1: \"near\" has no expectation"}};
  for (const auto& [text, message] : faults) {
    INFO(text);
    CHECK_THROWS_WITH(readText(text), Catch::Contains(message));
    CHECK_THROWS_AS(readText(text), raster::InputError);
  }
  CHECK_THROWS_AS(reference::readExpectations("no-such-file", suite), raster::InputError);
}

TEST_CASE("compare tells unexpected failures and unexpected passes from expected outcomes", "[verdict]") {
  const ExpectedResult fail{"near", Expectation::Fail, "x"}, flaky{"near", Expectation::Flaky, "x"};
  CHECK(compare(Outcome::Pass, {}) == Agreement::AsExpected);
  CHECK(compare(Outcome::Errors, {}) == Agreement::UnexpectedFailure);
  CHECK(compare(Outcome::Pass, fail) == Agreement::UnexpectedPass);
  CHECK(compare(Outcome::Errors, fail) == Agreement::AsExpected);
  CHECK(compare(Outcome::Pass, flaky) == Agreement::AsExpected);
  CHECK(compare(Outcome::Errors, flaky) == Agreement::AsExpected);
  CHECK(compare(Outcome::NotJudged, ExpectedResult{"near", Expectation::Unsupported, "x"}) == Agreement::AsExpected);
  CHECK(compare(Outcome::DeviceFailed, {}) == Agreement::UnexpectedFailure);
  CHECK(compare(Outcome::DeviceFailed, fail) == Agreement::AsExpected);
  CHECK(compare(Outcome::Missing, {}) == Agreement::UnexpectedFailure);
  CHECK(compare(Outcome::Missing, fail) == Agreement::UnexpectedFailure);
  CHECK(compare(Outcome::Missing, flaky) == Agreement::UnexpectedFailure);
}
