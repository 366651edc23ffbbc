#include "cli/vector/judging.h"

#include <algorithm>
#include <functional>
#include <iostream>

#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"
#include "raster/base/file_io.h"
#include "reference/calibration/device_class.h"
#include "reference/diagnosis/junit_report.h"
#include "reference/vectors/candidate.h"
#include "reference/verdict/minimal_failure.h"
#include "reference/verdict/verdict_picture.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using reference::Report;

bool isVector(const fs::path& folder) { return fs::exists(folder / "vector.json"); }

/// The vector folders of a suite, in the order of their names. Any other folder stands for itself.
std::vector<fs::path> vectorFolders(const fs::path& folder) {
  if (isVector(folder) || !fs::is_directory(folder)) return {folder};
  std::vector<fs::path> folders;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder))
    if (isVector(entry.path())) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  return folders.empty() ? std::vector{folder} : folders;
}

/// Without `.`, `..` and a slash at the end; links keep their names.
fs::path normalized(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

/// The expectations of all vectors in a folder.
reference::Expectations expectationsOf(const fs::path& file, const fs::path& folder) {
  if (file.empty()) return {};
  std::vector<std::string> names;
  for (const fs::path& vector : vectorFolders(folder)) names.push_back(normalized(vector).filename());
  return reference::readExpectations(file, names);
}

/// Counts by verdict, with `size` rows.
Table tableOf(const std::string& what, std::size_t size, const std::function<std::string(std::size_t)>& nameAt,
              const std::function<reference::VerdictCounts(std::size_t)>& countsAt) {
  std::vector<std::string> columns{what};
  for (const auto& verdict : reference::pixelVerdictNames) columns.emplace_back(verdict.name);
  const auto row = [=](std::size_t index) {
    std::vector<Cell> cells{nameAt(index)};
    for (const std::uint64_t count : countsAt(index)) cells.emplace_back(static_cast<std::int64_t>(count));
    return cells;
  };
  return {columns, size, row};
}

/// The reason, and below it what the program said.
std::string toText(const reference::DeviceFailure& device) {
  std::string text = nameOf(reference::deviceFaultNames, device.fault) + ", " + device.message + '\n';
  for (const std::string& line : device.process.lastLines) text += "  | " + line + '\n';
  return text;
}

/// A line on a vector that was not judged or for which something is expected; empty for any other.
std::string remarkOn(const Report& report) {
  const std::string& name = report.verdict.vector;
  const std::string expected = report.expected ? " (" + toText(*report.expected) + ")" : "";
  switch (outcomeOf(report)) {
    case reference::Outcome::NotJudged:
      return "not judged: " + name + expected + '\n';
    case reference::Outcome::Missing:
      return "missing: " + name + " was not drawn" + expected + '\n';
    case reference::Outcome::DeviceFailed:
      return "device failed: " + name + expected + ": " + toText(*report.device);
    case reference::Outcome::Errors:
      return report.expected ? "known errors: " + name + expected + '\n' : "";
    case reference::Outcome::Pass:
      return agreementOf(report) == reference::Agreement::UnexpectedPass ? "unexpected pass: " + name + expected + '\n'
                                                                         : "";
  }
  return {};
}

void printVector(const Report& report) {
  const std::vector<reference::FaceVerdict>& faces = report.verdict.faces;
  writeCsv(std::cout, tableOf(
                          "face", faces.size(), [&](std::size_t f) { return faces[f].name; },
                          [&](std::size_t f) { return countVerdicts(faces[f]); }));
  for (const reference::ErrorPixel& error : report.errors)
    std::cout << "error in " << error.face << ": " << toText(error) << '\n';
  std::cout << remarkOn(report);
  if (!report.findings.empty()) std::cout << "diagnosis: " << toText(report.findings) << '\n';
  if (report.reference) std::cout << "reference: " << toText(*report.reference) << '\n';
}

void printCounts(const std::vector<Report>& reports) {
  std::vector<const Report*> judged;
  for (const Report& report : reports)
    if (!report.verdict.faces.empty()) judged.push_back(&report);
  const auto nameAt = [&](std::size_t k) { return k < judged.size() ? judged[k]->verdict.vector : "all"; };
  const auto countsAt = [&](std::size_t k) {
    return k < judged.size() ? countVerdicts(judged[k]->verdict) : countVerdicts(reports);
  };
  writeCsv(std::cout, tableOf("vector", judged.size() + 1, nameAt, countsAt));
}

void printSuite(const std::vector<Report>& reports) {
  printCounts(reports);
  for (const Report& report : reports) {
    if (!report.errors.empty() && !report.expected)
      std::cout << "error in " << report.verdict.vector << ", " << report.errors[0].face << ": "
                << toText(report.errors[0]) << '\n';
    std::cout << remarkOn(report);
  }
  if (const auto common = reference::commonFault(reports)) std::cout << "diagnosis: " << toText(*common) << '\n';
  if (const auto check = checkReference(reports); check.pixels > 0) std::cout << "reference: " << toText(check) << '\n';
}

/// The class of device that explains errors under the default profile.
std::optional<reference::DeviceClass> suggestionFor(const JudgingOptions& options, const Suite& suite,
                                                    const std::vector<Report>& reports) {
  if (!options.profile.empty()) return {};
  std::vector<reference::JudgedVector> judged;
  for (std::size_t k = 0; k < reports.size(); ++k) judged.push_back({&suite.vectors[k].vector, &reports[k].verdict});
  return reference::guessDeviceClass(judged);
}

constexpr const char* howToCalibrate =
    "measure its profile before you look for faults: hemitex vector calibrate --probes PROBES, draw the probes like "
    "the suite, hemitex vector calibrate PROBES --candidate DRAWN -o profile.json, and check with --profile "
    "profile.json";

/// The results as a JSON object, with the suggestion or null.
std::string withSuggestion(const std::string& results, const std::optional<reference::DeviceClass>& guess) {
  nlohmann::ordered_json json = nlohmann::ordered_json::parse(results);
  json["suggestion"] = nullptr;
  if (guess)
    json["suggestion"] = {{"device", guess->properties},
                          {"errors", guess->errors},
                          {"explained", guess->explained},
                          {"profile", nlohmann::ordered_json::parse(toJson(guess->profile))},
                          {"advice", howToCalibrate}};
  return cli::toText(json);
}

/// Writes the smallest part of the vector that fails, and in `candidate` the device's item ID.
void writeMinimal(const fs::path& folder, const reference::MinimalFailure& minimal) {
  Staging staging(folder);
  reference::writeVector(staging.folder(), minimal.vector, {&minimal.expected, 1});
  const fs::path candidate = staging.folder() / "candidate";
  fs::create_directory(candidate);
  reference::writeCandidate(candidate, minimal.vector, {&minimal.found, 1});
  staging.commit();
}

/// The vector of the picture: the first with unexpected errors, else with errors, else with item buffers.
std::optional<std::size_t> shownVector(const JudgingOptions& options, const std::vector<Report>& reports) {
  const auto hasFailed = [&](const Report& report) {
    return hasErrors(report.verdict) && isFailure(report, options.isStrict);
  };
  const auto hasWrongPixels = [](const Report& report) { return hasErrors(report.verdict); };
  const auto isJudged = [](const Report& report) { return !report.verdict.faces.empty(); };
  for (const std::function<bool(const Report&)>& is :
       {std::function<bool(const Report&)>(hasFailed), std::function<bool(const Report&)>(hasWrongPixels),
        std::function<bool(const Report&)>(isJudged)}) {
    const auto place = std::find_if(reports.begin(), reports.end(), is);
    if (place != reports.end()) return static_cast<std::size_t>(place - reports.begin());
  }
  return {};
}

void writeFiles(const JudgingOptions& options, const Suite& suite, const std::vector<Report>& reports) {
  if (!options.junit.empty()) raster::writeFile(options.junit, toJUnit(reports, options.isStrict));
  const std::optional<std::size_t> shown = shownVector(options, reports);
  if (!shown) return;
  const reference::TestVector& vector = suite.vectors[*shown].vector;
  const reference::Verdict& verdict = reports[*shown].verdict;
  if (!options.picture.empty())
    radiosity::writePng(options.picture, toPicture(verdict, raster::backgroundId(vector.list.format)));
  if (options.minimal.empty() || !hasErrors(verdict)) return;
  writeMinimal(options.minimal, minimize(vector, verdict, profileOf(options)));
}

}  // namespace

void addJudgingOptions(Command command, JudgingOptions& options) {
  command.addPath("DIR", options.suite, "folder of the vector, or of a suite of vectors").required();
  command.addPath("--profile", options.profile,
                  "JSON file with the permitted deviations of the device (default: those of the Vulkan class)");
  command.addFlag("--exact", options.isExact,
                  "evaluate the rules in rational arithmetic, independently of the reference (slow)");
  const Option expectations =
      command.addPath("--expectations", options.expectations,
                      "expected results: lines NAME fail|unsupported|flaky REASON (default: all vectors pass)");
  command.addFlag("--strict", options.isStrict, "fail when a vector passes that is expected to fail")
      .needs(expectations);
  command.addPath("--junit", options.junit,
                  "write a JUnit XML file with one test suite per vector and one test case per face");
  command.addPath(
      "--diff", options.picture,
      "write a PNG file with expected, found and verdict side by side; for a suite, of the first failing vector");
  command.addPath(
      "--minimize", options.minimal,
      "write one failing pixel with as few triangles as possible into this folder, as a vector; for a suite, of the "
      "first failing vector");
}

Suite readSuite(const JudgingOptions& options) {
  Suite suite;
  const std::vector<fs::path> folders = vectorFolders(options.suite);
  suite.isSingle = folders == std::vector{options.suite};
  for (const fs::path& folder : folders)
    suite.vectors.push_back({normalized(folder), normalized(folder).filename(), reference::readVector(folder), {}});
  const fs::path folder = normalized(options.suite);
  const auto expectations = expectationsOf(options.expectations, suite.isSingle ? folder.parent_path() : folder);
  for (SuiteVector& vector : suite.vectors)
    if (const auto place = expectations.find(vector.name); place != expectations.end()) vector.expected = place->second;
  return suite;
}

fs::path answerFolder(const Suite& suite, const SuiteVector& vector, const fs::path& candidate) {
  return suite.isSingle ? candidate : candidate / vector.name;
}

bool isUnsupported(const SuiteVector& vector) {
  return vector.expected && vector.expected->expectation == reference::Expectation::Unsupported;
}

reference::DeviceProfile profileOf(const JudgingOptions& options) {
  return options.profile.empty() ? reference::DeviceProfile{} : reference::readProfile(options.profile);
}

Report judgeAnswer(const JudgingOptions& options, const reference::DeviceProfile& profile, const SuiteVector& vector,
                   const fs::path& folder) {
  Report report{{vector.name, {}}, {}, {}};
  report.isMissing = !fs::is_directory(folder);
  if (!report.isMissing && !isUnsupported(vector)) {
    const std::vector<raster::ItemBuffer> found = reference::readCandidate(folder, vector.vector);
    const auto judge = options.isExact ? reference::reportExactly : reference::reportOn;
    report = judge(vector.vector, found, profile);
  }
  report.expected = vector.expected;
  return report;
}

void writeResults(const JudgingOptions& options, const Suite& suite, const std::vector<Report>& reports,
                  Context& context) {
  const bool hasFailure =
      std::any_of(reports.begin(), reports.end(), [&](const Report& r) { return isFailure(r, options.isStrict); });
  context.failed = hasFailure || checkReference(reports).differing > 0;
  writeFiles(options, suite, reports);
  const std::optional<reference::DeviceClass> guess = suggestionFor(options, suite, reports);
  if (context.json) {
    std::cout << withSuggestion(suite.isSingle ? toJson(reports.front()) : reference::toJson(reports, options.isStrict),
                                guess);
    return;
  }
  suite.isSingle ? printVector(reports.front()) : printSuite(reports);
  if (guess) std::cout << "suggestion: " << toText(*guess) << "; " << howToCalibrate << '\n';
}

}  // namespace hemitex::cli
