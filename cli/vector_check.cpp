/// `hemitex vector check`: the item buffers of a device against the raster rules, pixel by pixel.
#include <iostream>
#include <memory>

#include "cli/commands.h"
#include "cli/staging.h"
#include "cli/table.h"
#include "radiosity/write_file.h"
#include "reference/candidate.h"
#include "reference/minimal_failure.h"
#include "reference/verdict_picture.h"
#include "reference/verdict_report.h"

namespace hemitex::cli {
namespace {

struct CheckOptions {
  std::filesystem::path vector, candidate, profile, junit, picture, minimal;
};

/// The counts of each face, as a table.
Table tableOf(const reference::Verdict& verdict) {
  std::vector<std::string> columns{"face"};
  for (std::size_t k = 0; k < reference::pixelVerdicts; ++k)
    columns.push_back(nameOf(static_cast<reference::PixelVerdict>(k)));
  const auto row = [&verdict](std::size_t index) {
    std::vector<Cell> cells{verdict.faces[index].name};
    for (const std::uint64_t count : countVerdicts(verdict.faces[index]))
      cells.emplace_back(static_cast<std::int64_t>(count));
    return cells;
  };
  return {columns, verdict.faces.size(), row};
}

/// The smallest part of the vector that fails, and beside it the device's word, as a candidate.
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
  const reference::TestVector vector = reference::readVector(options.vector);
  const reference::Verdict verdict = judge(vector, reference::readCandidate(options.candidate, vector), profile);
  const std::vector<reference::ErrorPixel> errors = firstErrors(vector, verdict);
  const std::vector<reference::Finding> findings = diagnose(vector, verdict);

  if (!options.junit.empty()) radiosity::writeFile(options.junit, toJUnit(verdict, errors, findings));
  if (!options.picture.empty())
    radiosity::writePng(options.picture, toPicture(verdict, raster::backgroundWord(vector.list.format)));
  if (context.json) {
    std::cout << toJson(verdict, errors, findings);
  } else {
    writeCsv(std::cout, tableOf(verdict));
    for (const reference::ErrorPixel& error : errors)
      std::cout << "error in " << error.face << ": " << toText(error) << '\n';
    if (!findings.empty()) std::cout << "diagnosis: " << toText(findings) << '\n';
  }
  context.failed = hasErrors(verdict);
  if (context.failed && !options.minimal.empty()) writeMinimal(options.minimal, minimize(vector, verdict, profile));
}

}  // namespace

void addVectorCheck(CLI::App& vector, Context& context) {
  const auto options = std::make_shared<CheckOptions>();
  CLI::App* command = vector.add_subcommand("check", "Judge a device's words: exact, explained, or an error (exit 1)");
  command->add_option("DIR", options->vector, "folder of the vector")->required();
  command->add_option("--candidate", options->candidate, "folder with the device's words")->required();
  command->add_option("--profile", options->profile, "what the device may do, as JSON (default: a Vulkan device)");
  command->add_option("--junit", options->junit, "JUnit XML, a test case a face");
  command->add_option("--diff", options->picture, "PNG with expected, found and verdict beside each other");
  command->add_option("--minimize", options->minimal, "folder for the fewest triangles and the pixel that still fail");
  command->callback([options, &context] { context.command = [options, &context] { check(*options, context); }; });
}

}  // namespace hemitex::cli
