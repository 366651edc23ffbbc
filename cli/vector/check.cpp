/// `hemitex vector check` compares the item buffers of a device with the raster rules, pixel by pixel, for one vector
/// or for a whole suite.
#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/diagnosis/verdict_report.h"
#include "reference/vectors/candidate.h"
#include "reference/verdict/minimal_failure.h"
#include "reference/verdict/verdict_picture.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;

struct CheckOptions {
  fs::path vector, candidate, profile, junit, picture, minimal;
  bool isExact = false;
};

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

/// Throws InputError with all vectors of a suite that have no folder in `candidate`.
void requireAnswers(const std::vector<fs::path>& vectors, const fs::path& candidate) {
  std::string missing;
  std::size_t count = 0;
  for (const fs::path& vector : vectors) {
    if (fs::is_directory(candidate / vector.filename())) continue;
    missing += (count++ == 0 ? "" : ", ") + vector.filename().string();
  }
  if (count > 0)
    throw raster::InputError(
        candidate.string(), 0,
        "has no folder for " + std::to_string(count) + " of " + std::to_string(vectors.size()) + " vectors: " + missing,
        "write one folder per vector; delete the vectors that the device cannot draw");
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

void printVector(const reference::Report& report, bool asJson) {
  if (asJson) {
    std::cout << toJson(report);
    return;
  }
  const std::vector<reference::FaceVerdict>& faces = report.verdict.faces;
  writeCsv(std::cout, tableOf(
                          "face", faces.size(), [&](std::size_t f) { return faces[f].name; },
                          [&](std::size_t f) { return countVerdicts(faces[f]); }));
  for (const reference::ErrorPixel& error : report.errors)
    std::cout << "error in " << error.face << ": " << toText(error) << '\n';
  if (!report.findings.empty()) std::cout << "diagnosis: " << toText(report.findings) << '\n';
  if (report.reference) std::cout << "reference: " << toText(*report.reference) << '\n';
}

void printSuite(const std::vector<reference::Report>& reports, bool asJson) {
  if (asJson) {
    std::cout << reference::toJson(reports);
    return;
  }
  const auto nameAt = [&](std::size_t k) { return k < reports.size() ? reports[k].verdict.vector : "all"; };
  const auto countsAt = [&](std::size_t k) {
    return k < reports.size() ? countVerdicts(reports[k].verdict) : countVerdicts(reports);
  };
  writeCsv(std::cout, tableOf("vector", reports.size() + 1, nameAt, countsAt));
  for (const reference::Report& report : reports)
    if (!report.errors.empty())
      std::cout << "error in " << report.verdict.vector << ", " << report.errors[0].face << ": "
                << toText(report.errors[0]) << '\n';
  if (const auto common = reference::commonFault(reports)) std::cout << "diagnosis: " << toText(*common) << '\n';
  if (reports.front().reference) std::cout << "reference: " << toText(checkReference(reports)) << '\n';
}

/// Writes the smallest part of the vector that fails, and in `candidate` the device's item ID.
void writeMinimal(const std::filesystem::path& folder, const reference::MinimalFailure& minimal) {
  Staging staging(folder);
  reference::writeVector(staging.folder(), minimal.vector, {&minimal.expected, 1});
  const std::filesystem::path candidate = staging.folder() / "candidate";
  std::filesystem::create_directory(candidate);
  reference::writeCandidate(candidate, minimal.vector, {&minimal.found, 1});
  staging.commit();
}

void check(const CheckOptions& options, Context& context) {
  const reference::DeviceProfile profile =
      options.profile.empty() ? reference::DeviceProfile{} : reference::readProfile(options.profile);
  const std::vector<fs::path> folders = vectorFolders(options.vector);
  const bool isSuite = folders != std::vector{options.vector};
  if (isSuite) requireAnswers(folders, options.candidate);
  std::vector<reference::TestVector> vectors;
  std::vector<reference::Report> reports;
  for (const fs::path& folder : folders) {
    vectors.push_back(reference::readVector(folder));
    const fs::path candidate = isSuite ? options.candidate / folder.filename() : options.candidate;
    const std::vector<raster::ItemBuffer> found = reference::readCandidate(candidate, vectors.back());
    const auto report = options.isExact ? reference::reportExactly : reference::reportOn;
    reports.push_back(report(vectors.back(), found, profile));
  }
  const auto failing = std::find_if(reports.begin(), reports.end(),
                                    [](const reference::Report& report) { return hasErrors(report.verdict); });
  const bool isFailing = failing != reports.end();
  context.failed = isFailing || checkReference(reports).differing > 0;

  const std::size_t shown = isFailing ? static_cast<std::size_t>(failing - reports.begin()) : 0;
  const reference::TestVector& vector = vectors[shown];
  const reference::Verdict& verdict = reports[shown].verdict;
  if (!options.junit.empty()) raster::writeFile(options.junit, toJUnit(reports));
  if (!options.picture.empty())
    radiosity::writePng(options.picture, toPicture(verdict, raster::backgroundId(vector.list.format)));
  if (isFailing && !options.minimal.empty()) writeMinimal(options.minimal, minimize(vector, verdict, profile));
  isSuite ? printSuite(reports, context.json) : printVector(reports.front(), context.json);
}

}  // namespace

void addVectorCheck(Command vector, Context& context) {
  const auto options = std::make_shared<CheckOptions>();
  const Command command = vector.addCommand(
      "check", "Compare the item IDs of a device with the raster rules (exit code 1 if a pixel is an error)");
  command.addPath("DIR", options->vector, "folder of the vector, or of a suite of vectors").required();
  command
      .addPath("--candidate", options->candidate,
               "folder with the device's item IDs; for a suite, one folder per vector")
      .required();
  command.addPath("--profile", options->profile,
                  "JSON file with the permitted deviations of the device (default: those of the Vulkan class)");
  command.addFlag("--exact", options->isExact,
                  "evaluate the rules in rational arithmetic, independently of the reference (slow)");
  command.addPath("--junit", options->junit,
                  "write a JUnit XML file with one test suite per vector and one test case per face");
  command.addPath(
      "--diff", options->picture,
      "write a PNG file with expected, found and verdict side by side; for a suite, of the first failing vector");
  command.addPath(
      "--minimize", options->minimal,
      "write one failing pixel with as few triangles as possible into this folder, as a vector; for a suite, of the "
      "first failing vector");
  command.onRead([options, &context] { context.command = [options, &context] { check(*options, context); }; });
}

}  // namespace hemitex::cli
