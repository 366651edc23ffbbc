/// The common part of `vector check` and `vector run`: reads the suite and what is expected of the device, judges item
/// buffers, and writes the results.
#pragma once

#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cli/common/options.h"
#include "cli/common/staging.h"
#include "raster/base/parallel.h"
#include "reference/conformance/diagnosis/verdict_report.h"

namespace hemitex::cli {

/// Part `number` of a suite that `count` runs share: every count-th vector.
struct Shard {
  std::size_t number = 1, count = 1;
};

struct JudgingOptions {
  std::filesystem::path suite, profile, expectations, junit, page, picture, minimal, record;
  std::string device, driver;  ///< names for the record
  Shard shard;
  bool isExact = false, isStrict = false, isDepthStrict = false;
};
void addJudgingOptions(Command command, JudgingOptions& options);

/// make(0), make(1), ... on all threads. Throws what the first of them throws.
template <typename Value>
std::vector<Value> makeAll(std::size_t count, const std::function<Value(std::size_t)>& make) {
  std::vector<Value> values(count);
  std::vector<std::exception_ptr> errors(count);
  raster::parallelFor(count, [&](std::size_t k) {
    try {
      values[k] = make(k);
    } catch (...) {
      errors[k] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return values;
}

struct SuiteVector {
  std::filesystem::path folder;  ///< absolute
  std::string name;              ///< of the folder
  reference::TestVector vector;
  std::optional<reference::ExpectedResult> expected;
};

struct Suite {
  std::filesystem::path folder;      ///< absolute
  std::vector<SuiteVector> vectors;  ///< in the order of their names
  bool isSingle = false;             ///< the folder of one vector, not of several
};

/// Reads all vectors of the shard, and expectations. The folder of one vector may share the expectations of the vectors
/// beside it. Throws InputError for a folder or a shard without vectors and for wrong expectations.
Suite readSuite(const JudgingOptions& options);

/// Throws InputError unless the folder with a device's item IDs is one.
void requireCandidate(const std::filesystem::path& folder);

/// The folder of a device's item IDs for a vector.
std::filesystem::path answerFolder(const Suite& suite, const SuiteVector& vector,
                                   const std::filesystem::path& candidate);

bool isUnsupported(const SuiteVector& vector);

/// The default profile without an option.
reference::DeviceProfile profileOf(const JudgingOptions& options);

/// The report on a device's item IDs in `folder`. Without the folder the vector is missing; an unsupported vector is
/// not judged. Throws InputError for an item ID file that is missing or has the wrong size.
reference::Report judgeAnswer(const JudgingOptions& options, const reference::DeviceProfile& profile,
                              const SuiteVector& vector, const std::filesystem::path& folder);

/// A small vector that shows a failure: its item IDs by the rules and by the device, which has none if it fails to
/// draw.
struct SmallFailure {
  reference::TestVector vector;
  std::vector<raster::ItemBuffer> expected, found;
};
using Minimizer = std::function<SmallFailure(const SuiteVector&, const reference::Report&)>;

/// The files that were asked for. Throws InputError for one that cannot be written, before the work.
struct JudgingFiles {
  JudgingFiles(const JudgingOptions& options, const Context& context);

  std::optional<Staging> junit, page, record, picture, minimal;
};

/// Writes the requested files, prints the results, and sets `context.failed` if a result is not as expected.
void writeResults(const JudgingOptions& options, JudgingFiles& files, const Suite& suite,
                  const std::vector<reference::Report>& reports, const Minimizer& minimize, Context& context);

}  // namespace hemitex::cli
