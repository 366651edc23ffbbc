#include "cli/vector/judging.h"

#include <algorithm>
#include <iostream>

#include "cli/common/json.h"
#include "cli/common/table.h"
#include "cli/vector/results_page.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/conformance/calibration/device_class.h"
#include "reference/conformance/pictures/verdict_picture.h"
#include "reference/conformance/records/conformance_record.h"
#include "reference/conformance/vectors/vector_file.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using reference::Report;

/// Without `.`, `..` and a slash at the end; links keep their names.
fs::path normalized(const fs::path& folder) {
  const fs::path path = fs::absolute(folder).lexically_normal();
  return path.has_filename() ? path : path.parent_path();
}

/// The expectations of all vectors in a folder.
reference::Expectations expectationsOf(const fs::path& file, const fs::path& folder) {
  if (file.empty()) return {};
  std::vector<std::string> names;
  for (const fs::path& vector : reference::vectorFolders(folder)) names.push_back(normalized(vector).filename());
  return reference::readExpectations(file, names);
}

/// Reads `I/N`. Throws a usage error.
Shard shardOption(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto number = parseInteger(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : parseInteger(text.substr(slash + 1));
  if (!number || !count || *number < 1 || *count < *number)
    usageError("--shard", "`" + text + "` is not I/N with I from 1 to N");
  return {static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
}

/// Throws InputError if there are fewer folders than parts.
std::vector<fs::path> partOf(const std::vector<fs::path>& folders, const Shard& shard) {
  if (folders.size() < shard.count)
    throw raster::InputError("the suite has fewer vectors, " + std::to_string(folders.size()) + ", than parts, " +
                                 std::to_string(shard.count),
                             "share it among fewer runs");
  std::vector<fs::path> part;
  for (std::size_t k = shard.number - 1; k < folders.size(); k += shard.count) part.push_back(folders[k]);
  return part;
}

/// Prints counts by verdict, with the name of what each row counts.
void print(const std::string& what, const std::vector<std::pair<std::string, reference::VerdictCounts>>& rows) {
  std::vector<std::string> columns{what};
  for (const auto& verdict : reference::pixelVerdictNames) columns.emplace_back(verdict.name);
  const auto row = [&rows](std::size_t index) {
    std::vector<Cell> cells{rows[index].first};
    for (const std::uint64_t count : rows[index].second) cells.emplace_back(static_cast<std::int64_t>(count));
    return cells;
  };
  writeCsv(std::cout, {columns, rows.size(), row});
}

/// The reason, and below it what the program said.
std::string failureText(const reference::DeviceFailure& device) {
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
      return "device failed: " + name + expected + ": " + failureText(*report.device);
    case reference::Outcome::NotDeterministic:
      return "not deterministic: " + name + expected + ": " + toText(*report.repetition) + '\n';
    case reference::Outcome::Errors:
      return report.expected ? "known errors: " + name + expected + '\n' : "";
    case reference::Outcome::Pass:
      return agreementOf(report) == reference::Agreement::UnexpectedPass ? "unexpected pass: " + name + expected + '\n'
                                                                         : "";
  }
  return {};
}

/// Two faults that explain more vectors than one.
std::optional<reference::CommonPair> commonPairOf(const Suite& suite, const std::vector<Report>& reports) {
  std::vector<const reference::TestVector*> vectors;
  for (const SuiteVector& vector : suite.vectors) vectors.push_back(&vector.vector);
  return reference::commonPair(reports, vectors);
}

/// The diagnosis of all vectors; empty without one.
std::string diagnosisOf(const Suite& suite, const std::vector<Report>& reports) {
  if (const auto pair = commonPairOf(suite, reports)) return toText(*pair);
  const auto common = reference::commonFault(reports);
  return common ? toText(*common) : "";
}

void printVector(const Suite& suite, const std::vector<Report>& reports) {
  const Report& report = reports.front();
  std::vector<std::pair<std::string, reference::VerdictCounts>> counts;
  for (const reference::FaceVerdict& face : report.verdict.faces) counts.emplace_back(face.name, countVerdicts(face));
  print("face", counts);
  for (const reference::ErrorPixel& error : report.errors)
    std::cout << "error in " << error.face << ": " << toText(error) << '\n';
  std::cout << remarkOn(report);
  if (!report.findings.empty())
    std::cout << "diagnosis: " << toText(report.findings) << '\n';
  else if (const auto pair = commonPairOf(suite, reports))
    std::cout << "diagnosis: " << toText(*pair) << '\n';
  if (report.reference) std::cout << "reference: " << toText(*report.reference) << '\n';
}

void printSuite(const Suite& suite, const std::vector<Report>& reports) {
  std::vector<std::pair<std::string, reference::VerdictCounts>> counts;
  for (const Report& report : reports)
    if (!report.verdict.faces.empty()) counts.emplace_back(report.verdict.vector, countVerdicts(report.verdict));
  counts.emplace_back("all", countVerdicts(reports));
  print("vector", counts);
  for (const Report& report : reports) {
    if (!report.errors.empty() && !report.expected)
      std::cout << "error in " << report.verdict.vector << ", " << report.errors[0].face << ": "
                << toText(report.errors[0]) << '\n';
    std::cout << remarkOn(report);
  }
  if (const std::string text = diagnosisOf(suite, reports); !text.empty()) std::cout << "diagnosis: " << text << '\n';
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
nlohmann::ordered_json withSuggestion(nlohmann::ordered_json json, const std::optional<reference::DeviceClass>& guess) {
  json["suggestion"] = nullptr;
  if (guess)
    json["suggestion"] = {{"device", guess->properties},
                          {"errors", guess->errors},
                          {"explained", guess->explained},
                          {"profile", toJson(guess->profile)},
                          {"advice", howToCalibrate}};
  return json;
}

/// Writes the vector, and in `candidate` the device's item IDs.
void writeSmall(Staging& staging, const SmallFailure& small) {
  reference::writeVector(staging.folder(), small.vector, small.expected);
  if (!small.found.empty()) {
    fs::create_directory(staging.folder() / "candidate");
    reference::writeCandidate(staging.folder() / "candidate", small.vector, small.found);
  }
  staging.commit();
}

reference::ConformanceRecord recordOf(const JudgingOptions& options, const Suite& suite,
                                      const std::vector<Report>& reports) {
  reference::ConformanceRecord record;
  record.device = options.device;
  record.driver = options.driver;
  record.profile = profileOf(options);
  for (std::size_t k = 0; k < reports.size(); ++k)
    record.vectors.push_back(recordOf(reports[k], suite.vectors[k].folder));
  return record;
}

using Predicate = std::function<bool(const Report&)>;

/// The first report that satisfies the first predicate, else the second, and so on.
std::optional<std::size_t> firstOf(const std::vector<Report>& reports, const std::vector<Predicate>& predicates) {
  for (const Predicate& is : predicates) {
    const auto place = std::find_if(reports.begin(), reports.end(), is);
    if (place != reports.end()) return static_cast<std::size_t>(place - reports.begin());
  }
  return {};
}

/// Writes the picture of the first vector with unexpected errors, else with errors, else with item buffers.
void writePicture(const fs::path& file, const JudgingOptions& options, const Suite& suite,
                  const std::vector<Report>& reports) {
  const auto hasWrongPixels = [](const Report& report) { return hasErrors(report.verdict); };
  const auto isUnexpected = [&](const Report& report) {
    return hasWrongPixels(report) && isFailure(report, options.isStrict);
  };
  const auto isJudged = [](const Report& report) { return !report.verdict.faces.empty(); };
  const auto shown = firstOf(reports, {isUnexpected, hasWrongPixels, isJudged});
  if (shown)
    radiosity::writePng(
        file, toPicture(reports[*shown].verdict, raster::backgroundId(suite.vectors[*shown].vector.list.format)));
}

/// Pictures are made in the folder `scratch`.
std::string pageOf(const Suite& suite, const std::vector<Report>& reports, const fs::path& scratch) {
  ResultsPage page{.suite = suite.folder.filename(), .diagnosis = diagnosisOf(suite, reports), .results = {}};
  for (std::size_t k = 0; k < reports.size(); ++k)
    page.results.push_back({suite.vectors[k].vector, reports[k], remarkOn(reports[k])});
  return toHtml(page, scratch);
}

/// Minimizes the first vector that fails unexpectedly, else the first that fails.
void writeMinimal(Staging& staging, const JudgingOptions& options, const Suite& suite,
                  const std::vector<Report>& reports, const Minimizer& minimize) {
  const auto fails = [](const Report& report) { return hasErrors(report.verdict) || report.device; };
  const auto isUnexpected = [&](const Report& report) { return fails(report) && isFailure(report, options.isStrict); };
  if (const auto failing = firstOf(reports, {isUnexpected, fails}))
    writeSmall(staging, minimize(suite.vectors[*failing], reports[*failing]));
}

void writeFiles(const JudgingOptions& options, JudgingFiles& files, const Suite& suite,
                const std::vector<Report>& reports, const Minimizer& minimize) {
  if (files.junit) raster::writeFile(files.junit->file(), toJUnit(reports, options.isStrict));
  if (files.record) raster::writeFile(files.record->file(), toJson(recordOf(options, suite, reports)));
  if (files.page) raster::writeFile(files.page->file(), pageOf(suite, reports, files.page->folder()));
  if (files.picture) writePicture(files.picture->file(), options, suite, reports);
  if (files.minimal) writeMinimal(*files.minimal, options, suite, reports, minimize);
  for (std::optional<Staging>* file : {&files.junit, &files.page, &files.record, &files.picture})
    if (*file) (*file)->commit();
}

}  // namespace

JudgingFiles::JudgingFiles(const JudgingOptions& options, const Context& context) {
  const auto open = [&](std::optional<Staging>& staging, const fs::path& file, const std::string& option) {
    if (file.empty()) return;
    staging.emplace(Output{Output::Kind::File, file, "vector check " + option, context.inputs()});
    staging->requirePlaces({file.filename()});
  };
  open(junit, options.junit, "--junit");
  open(page, options.page, "--html");
  open(record, options.record, "--record");
  open(picture, options.picture, "--diff");
  if (options.minimal.empty()) return;
  minimal.emplace(Output{.place = options.minimal, .writer = "vector check", .inputs = context.inputs()});
  minimal->requirePlaces({"vector.json"});
}

void addJudgingOptions(Command command, JudgingOptions& options) {
  command.addPath("DIR", options.suite, "folder of the vector, or of a suite of vectors").required();
  const Option shard = command.addText("--shard", "I/N", "only part I of N equal parts of the suite (default 1/1)",
                                       [&options](const std::string& text) { options.shard = shardOption(text); });
  const Command rules = command.under("Rules");
  rules.addPath("--profile", options.profile,
                "JSON file with the permitted deviations of the device (default: those of the Vulkan class)");
  rules.addFlag("--strict-depth", options.isDepthStrict,
                "do not excuse equal depths: of two triangles with the same corners the first one drawn must stay");
  rules.addFlag("--exact", options.isExact,
                "evaluate the rules in rational arithmetic, independently of the reference (slow)");
  const Option expectations =
      rules.addPath("--expectations", options.expectations,
                    "expected results: lines NAME fail|unsupported|flaky REASON (default: all vectors pass)");
  rules.addFlag("--strict", options.isStrict, "fail when a vector passes that is expected to fail").needs(expectations);
  const Command files = command.under("Files");
  files.addOutputFile("--junit", options.junit,
                      "write a JUnit XML file with one test suite per vector and one test case per face");
  files.addOutputFile(
      "--html", options.page,
      "write an HTML page with all results, and for each failing vector its pictures, diagnosis and the "
      "derivation of a wrong pixel");
  files.addOutputFile(
      "--diff", options.picture,
      "write a PNG file with expected, found and verdict side by side; for a suite, of the first failing vector");
  files.addOutputFolder(
      "--minimize", options.minimal,
      "write a vector that fails with as few triangles and pixels as possible into this folder; for a "
      "suite, from the first "
      "failing vector");
  const Option record =
      files.addOutputFile("--record", options.record, "write a conformance record into this JSON file");
  const Option device = files.addText("--device-name", "NAME", "the device, for the record", options.device);
  const Option driver = files.addText("--driver", "NAME", "its driver and version, for the record", options.driver);
  record.needs(device).needs(driver);
  device.needs(record);
  driver.needs(record);
  record.excludes(shard);
}

Suite readSuite(const JudgingOptions& options) {
  Suite suite{.folder = normalized(options.suite), .vectors = {}};
  const std::vector<fs::path> all = reference::vectorFolders(options.suite);
  const std::vector<fs::path> folders = partOf(all, options.shard);
  suite.isSingle = all == std::vector{options.suite};
  suite.vectors = makeAll<SuiteVector>(folders.size(), [&](std::size_t k) -> SuiteVector {
    const fs::path folder = normalized(folders[k]);
    return {folder, folder.filename(), reference::readVector(folders[k]), {}};
  });
  const auto expectations =
      expectationsOf(options.expectations, suite.isSingle ? suite.folder.parent_path() : suite.folder);
  for (SuiteVector& vector : suite.vectors)
    if (const auto place = expectations.find(vector.name); place != expectations.end()) vector.expected = place->second;
  return suite;
}

void requireCandidate(const fs::path& folder) {
  if (!fs::is_directory(folder))
    throw raster::InputError(folder.string(), 0, "is not a folder", "name the folder with the device's item IDs");
}

fs::path answerFolder(const Suite& suite, const SuiteVector& vector, const fs::path& candidate) {
  return suite.isSingle ? candidate : candidate / vector.name;
}

bool isUnsupported(const SuiteVector& vector) {
  return vector.expected && vector.expected->expectation == reference::Expectation::Unsupported;
}

reference::DeviceProfile profileOf(const JudgingOptions& options) {
  reference::DeviceProfile profile =
      options.profile.empty() ? reference::DeviceProfile{} : reference::readProfile(options.profile);
  profile.strictDepth |= options.isDepthStrict;
  return profile;
}

Report judgeAnswer(const JudgingOptions& options, const reference::DeviceProfile& profile, const SuiteVector& vector,
                   const fs::path& folder) {
  Report report{{vector.name, {}}, {}, {}};
  report.isMissing = !fs::is_directory(folder);
  if (!report.isMissing && !isUnsupported(vector)) {
    const std::vector<raster::ItemBuffer> found = reference::readCandidate(folder, vector.vector);
    report = reference::reportOn(vector.vector, found, profile, options.isExact);
  }
  report.expected = vector.expected;
  return report;
}

void writeResults(const JudgingOptions& options, JudgingFiles& files, const Suite& suite,
                  const std::vector<Report>& reports, const Minimizer& minimize, Context& context) {
  const bool hasFailure =
      std::any_of(reports.begin(), reports.end(), [&](const Report& r) { return isFailure(r, options.isStrict); });
  context.failed = hasFailure || checkReference(reports).differing > 0;
  writeFiles(options, files, suite, reports, minimize);
  const std::optional<reference::DeviceClass> guess = suggestionFor(options, suite, reports);
  if (context.json) {
    auto results = suite.isSingle ? toJson(reports.front()) : reference::toJson(reports, options.isStrict);
    if (const auto pair = commonPairOf(suite, reports)) results["pair"] = toJson(*pair);
    std::cout << toText(withSuggestion(results, guess));
    return;
  }
  suite.isSingle ? printVector(suite, reports) : printSuite(suite, reports);
  if (guess) std::cout << "suggestion: " << toText(*guess) << "; " << howToCalibrate << '\n';
}

}  // namespace hemitex::cli
