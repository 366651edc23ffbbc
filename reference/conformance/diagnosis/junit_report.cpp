#include "reference/conformance/diagnosis/junit_report.h"

#include <algorithm>
#include <vector>

namespace hemitex::reference {
namespace {

struct TestCase {
  std::string name;
  std::string result = {};   ///< `failure` or `skipped`; empty for a pass
  std::string message = {};  ///< of the result
  std::string text = {};     ///< lines below the message
};

TestCase caseOf(const Report& report, const FaceVerdict& face) {
  const std::uint64_t wrong = countVerdicts(face)[static_cast<std::size_t>(PixelVerdict::Error)];
  if (wrong == 0) return {face.name};
  const std::string message = std::to_string(wrong) + " pixels are errors";
  if (report.expected) return {face.name, "skipped", message + ", " + toText(*report.expected)};
  TestCase result{face.name, "failure", message};
  if (!report.findings.empty()) result.text = "diagnosis: " + toText(report.findings) + '\n';
  for (const ErrorPixel& error : report.errors)
    if (error.face == face.name) result.text += toText(error) + '\n';
  return result;
}

TestCase caseOf(const Report& report, const DeviceFailure& device) {
  const std::string message = nameOf(deviceFaultNames, device.fault) + ": " + device.message;
  if (report.expected) return {"all faces", "skipped", message + ", " + toText(*report.expected)};
  TestCase result{"all faces", "failure", message};
  for (const std::string& line : device.process.lastLines) result.text += line + '\n';
  return result;
}

std::vector<TestCase> casesOf(const Report& report, bool isStrict) {
  const Outcome outcome = outcomeOf(report);
  if (outcome == Outcome::NotJudged) return {{"all faces", "skipped", toText(*report.expected)}};
  if (outcome == Outcome::Missing) return {{"all faces", "failure", "missing: the vector was not drawn"}};
  if (report.device) return {caseOf(report, *report.device)};
  std::vector<TestCase> cases;
  for (const FaceVerdict& face : report.verdict.faces) cases.push_back(caseOf(report, face));
  if (outcome == Outcome::NotDeterministic)
    cases.push_back(
        {"all runs", report.expected ? "skipped" : "failure", "not deterministic: " + toText(*report.repetition)});
  if (isStrict && agreementOf(report) == Agreement::UnexpectedPass)
    cases.push_back({"expectation", "failure", "unexpected pass, " + toText(*report.expected)});
  return cases;
}

/// Text for XML. Control characters become blanks, but line ends stay with `keepsLines`.
std::string xmlText(const std::string& text, bool keepsLines = false) {
  std::string result;
  for (const char c : text) {
    const bool isControl = static_cast<unsigned char>(c) < 0x20 && !(keepsLines && c == '\n');
    result += c == '&'    ? "&amp;"
              : c == '<'  ? "&lt;"
              : c == '>'  ? "&gt;"
              : c == '"'  ? "&quot;"
              : isControl ? " "
                          : std::string(1, c);
  }
  return result;
}

std::string xmlOf(const std::string& vector, const TestCase& test) {
  const std::string start = "    <testcase classname=\"" + xmlText(vector) + "\" name=\"" + xmlText(test.name) + "\"";
  if (test.result.empty()) return start + "/>\n";
  return start + ">\n      <" + test.result + " message=\"" + xmlText(test.message) + "\">" + xmlText(test.text, true) +
         "</" + test.result + ">\n    </testcase>\n";
}

/// The test suite of one vector.
std::string testSuite(const Report& report, bool isStrict) {
  const std::vector<TestCase> cases = casesOf(report, isStrict);
  const auto count = [&](const std::string& result) {
    return std::to_string(
        std::count_if(cases.begin(), cases.end(), [&](const TestCase& test) { return test.result == result; }));
  };
  std::string text;
  for (const TestCase& test : cases) text += xmlOf(report.verdict.vector, test);
  const std::string skipped = count("skipped") == "0" ? "" : " skipped=\"" + count("skipped") + "\"";
  return "  <testsuite name=\"" + xmlText(report.verdict.vector) + "\" tests=\"" + std::to_string(cases.size()) +
         "\" failures=\"" + count("failure") + "\"" + skipped + ">\n" + text + "  </testsuite>\n";
}

}  // namespace

std::string toJUnit(std::span<const Report> reports, bool isStrict) {
  std::string suites;
  for (const Report& report : reports) suites += testSuite(report, isStrict);
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n" + suites + "</testsuites>\n";
}

}  // namespace hemitex::reference
