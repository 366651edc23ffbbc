/// `hemitex vector check` compares the item buffers of a device with the raster rules, pixel by pixel, for one vector
/// or for a whole suite.
#include <memory>

#include "cli/common/commands.h"
#include "cli/vector/judging.h"
#include "reference/conformance/verdict/reduction.h"

namespace hemitex::cli {
namespace {

struct CheckOptions {
  JudgingOptions judging;
  std::filesystem::path candidate;
};

void check(const CheckOptions& options, Context& context) {
  const Suite suite = readSuite(options.judging);
  requireCandidate(options.candidate);
  JudgingFiles files(options.judging, context);
  const reference::DeviceProfile profile = profileOf(options.judging);
  auto reports = makeAll<reference::Report>(suite.vectors.size(), [&](std::size_t k) {
    const SuiteVector& vector = suite.vectors[k];
    return judgeAnswer(options.judging, profile, vector, answerFolder(suite, vector, options.candidate));
  });
  reference::nameStaleFrames(reports);
  const auto minimal = [&](const SuiteVector& vector, const reference::Report& report) -> SmallFailure {
    const reference::MinimalFailure failure = minimize(vector.vector, report.verdict, profile);
    return {failure.vector, {failure.expected}, {failure.found}};
  };
  writeResults(options.judging, files, suite, reports, minimal, context);
}

}  // namespace

void addVectorCheck(Command vector, Context& context) {
  const auto options = std::make_shared<CheckOptions>();
  const Command command = vector.addCommand(
      "check", "Compare the item IDs of a device with the raster rules (exit code 1 if a pixel is an error)");
  command.under("Device")
      .addPath("--candidate", options->candidate,
               "folder with the device's item IDs; for a suite, one folder per vector")
      .required();
  addJudgingOptions(command, options->judging);
  command.showFirst({"--candidate", "--profile", "--strict-depth", "--exact", "--expectations", "--strict", "--junit",
                     "--diff", "--minimize", "--record"});
  command.addExamples(
      {"suite --candidate drawn", "suite --candidate drawn --profile profile.json --junit results.xml"});
  command.onRead([options, &context] { context.command = [options, &context] { check(*options, context); }; });
}

}  // namespace hemitex::cli
