/// `hemitex vector verify` computes a conformance record again: its hashes, those of the suite, and, with the item IDs
/// of the device, the verdicts.
#include <algorithm>
#include <iostream>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/vector/judging.h"
#include "reference/conformance/records/conformance_record.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using reference::ConformanceRecord;
using reference::RecordedVector;

struct VerifyOptions {
  fs::path record, suite, candidate;
};

struct Verification {
  std::vector<std::string> problems;
  std::vector<std::string> notChecked;
};

const RecordedVector* find(const ConformanceRecord& record, const std::string& name) {
  const auto place = std::find_if(record.vectors.begin(), record.vectors.end(),
                                  [&](const RecordedVector& vector) { return vector.name == name; });
  return place == record.vectors.end() ? nullptr : &*place;
}

/// Whether the item IDs of the vector were judged, so that a candidate can be judged again.
bool wasJudged(const RecordedVector& vector) { return !vector.faces.empty(); }

/// The entry of the vector as it is now; without a candidate it has no faces.
RecordedVector entryOf(const VerifyOptions& options, const ConformanceRecord& record, const Suite& suite,
                       const SuiteVector& vector, const RecordedVector& recorded) {
  reference::Report report{{vector.name, {}}, {}, {}};
  if (!options.candidate.empty() && wasJudged(recorded))
    report = judgeAnswer({}, record.profile, vector, answerFolder(suite, vector, options.candidate));
  return recordOf(report, vector.folder);
}

void verifyVector(const VerifyOptions& options, const ConformanceRecord& record, const Suite& suite,
                  const SuiteVector& vector, Verification& result) {
  const RecordedVector* recorded = find(record, vector.name);
  if (!recorded) {
    result.problems.push_back(vector.name + ": is in the suite, but not in the record");
    return;
  }
  const RecordedVector found = entryOf(options, record, suite, vector, *recorded);
  if (!options.candidate.empty() && wasJudged(*recorded) && found.faces.empty())
    result.problems.push_back(vector.name + ": the candidate has no item IDs");
  if (!options.candidate.empty() && !wasJudged(*recorded))
    result.notChecked.push_back(vector.name + ": the record has no item IDs (" +
                                nameOf(reference::outcomeNames, recorded->outcome) + ")");
  for (const std::string& line : differences(*recorded, found)) result.problems.push_back(line);
}

Verification verifyRecord(const VerifyOptions& options, const reference::RecordFile& file, const Suite& suite) {
  Verification result{file.damage, {}};
  for (const RecordedVector& recorded : file.record.vectors)
    if (std::none_of(suite.vectors.begin(), suite.vectors.end(),
                     [&](const SuiteVector& vector) { return vector.name == recorded.name; }))
      result.problems.push_back(recorded.name + ": is in the record, but not in the suite");
  for (const SuiteVector& vector : suite.vectors) verifyVector(options, file.record, suite, vector, result);
  if (options.candidate.empty()) result.notChecked.push_back("item IDs and verdicts: no candidate was given");
  return result;
}

void print(const reference::RecordFile& file, const Verification& result) {
  const ConformanceRecord& record = file.record;
  std::cout << "record of " << record.device << ", driver " << record.driver << ", raster rules " << record.rules
            << ", " << record.vectors.size() << " vectors\n";
  for (const std::string& problem : result.problems) std::cout << "wrong: " << problem << '\n';
  for (const std::string& part : result.notChecked) std::cout << "not checked: " << part << '\n';
  std::cout << (result.problems.empty() ? "all that was checked agrees with the record\n"
                                        : "the record does not agree\n");
}

void verify(const VerifyOptions& options, Context& context) {
  const reference::RecordFile file = reference::readRecord(options.record);
  if (!options.candidate.empty()) requireCandidate(options.candidate);
  JudgingOptions judging;
  judging.suite = options.suite;
  const Verification result = verifyRecord(options, file, readSuite(judging));
  context.failed = !result.problems.empty();
  if (context.json)
    std::cout << toText({{"valid", result.problems.empty()},
                         {"device", file.record.device},
                         {"driver", file.record.driver},
                         {"vectors", file.record.vectors.size()},
                         {"problems", result.problems},
                         {"not_checked", result.notChecked}});
  else
    print(file, result);
}

}  // namespace

void addVectorVerify(Command vector, Context& context) {
  const auto options = std::make_shared<VerifyOptions>();
  const Command command = vector.addCommand("verify", "Compute a conformance record again (exit code 1 if it differs)");
  command.addPath("RECORD", options->record, "JSON file written with --record").required();
  command.addPath("--suite", options->suite, "folder of the suite").required();
  command.addPath("--candidate", options->candidate, "folder with the device's item IDs (default: only the suite)");
  command.addExamples({"record.json --suite suite", "record.json --suite suite --candidate drawn"});
  command.onRead([options, &context] { context.command = [options, &context] { verify(*options, context); }; });
}

}  // namespace hemitex::cli
