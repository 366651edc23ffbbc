/// Reports of verdicts as text, JSON and JUnit XML.
#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "reference/conformance/diagnosis/diagnosis.h"
#include "reference/conformance/verdict/device_process.h"
#include "reference/conformance/verdict/error_pixel.h"
#include "reference/conformance/verdict/expectations.h"
#include "reference/conformance/verdict/repetition.h"

namespace hemitex::reference {

/// The reference renderer compared with the independent evaluator (rational_rasterizer.h).
struct ReferenceCheck {
  std::uint64_t pixels = 0;     ///< of all faces
  std::uint64_t differing = 0;  ///< of these, with different item IDs
};

/// A verdict, its first errors and the faults that may explain them.
struct Report {
  Verdict verdict;
  std::vector<ErrorPixel> errors;
  std::vector<Finding> findings;
  std::optional<ReferenceCheck> reference = {};  ///< only in an exact report
  std::optional<ExpectedResult> expected = {};   ///< none: the vector is expected to pass
  bool isMissing = false;                        ///< the device did not draw the vector; no faces
  std::optional<DeviceFailure> device = {};      ///< of the program that should have drawn the vector; no faces
  std::optional<Repetition> repetition = {};     ///< only of several runs; the verdict is that of the first one
  std::vector<std::string> explaining = {};      ///< the faults that explain the errors (diagnosis.h)
};

Outcome outcomeOf(const Report& report);
Agreement agreementOf(const Report& report);
/// Whether the result is not as expected. With `isStrict` an unexpected pass is a failure, too.
bool isFailure(const Report& report, bool isStrict);

/// The report on what a device drew: judge, firstErrors and diagnose. With `isExact` the independent evaluator gives
/// the expected item IDs, and is compared with the reference renderer. Its cost is pixels times triangles.
Report reportOn(const TestVector& vector, std::span<const raster::ItemBuffer> found, const DeviceProfile& profile,
                bool isExact = false);

/// Over all reports that compare the reference.
ReferenceCheck checkReference(std::span<const Report> reports);

/// "agrees with the independent evaluator at 768 pixels", or how many of them differ.
std::string toText(const ReferenceCheck& check);

/// Over all faces of all vectors.
VerdictCounts countVerdicts(std::span<const Report> reports);

/// The fault that explains most of the failing vectors, of those that a vector names. It may be unique even if single
/// vectors name several faults.
struct CommonFault {
  Finding finding;           ///< of the first vector that names it
  std::size_t vectors = 0;   ///< vectors that it explains
  std::size_t failures = 0;  ///< vectors with errors
};

/// Of equals the first one. Nothing if a fault explains fewer than one in twenty of the failing vectors: it may agree
/// by chance.
std::optional<CommonFault> commonFault(std::span<const Report> reports);

/// Whether it explains less than half of the failing vectors: the rest has another cause, and it may be a coincidence.
bool isWeak(const CommonFault& common);

/// "linear filtering, in 3 of 4 vectors with errors: set both filters ...". A weak one is said as a guess.
std::string toText(const CommonFault& common);

/// Two faults that explain more failing vectors than the common fault, each alone or both together.
struct CommonPair {
  PairFinding findings;
  std::size_t vectors = 0;   ///< vectors that they explain
  std::size_t failures = 0;  ///< vectors with errors
};

/// Nothing where the common fault explains all, and where no pair explains more than half of the vectors that it
/// leaves. `vectors` are those of the reports. Pairs come from the four smallest vectors that no fault explains alone.
std::optional<CommonPair> commonPair(std::span<const Report> reports, std::span<const TestVector* const> vectors);

/// "y of the view flipped and linear filtering, in 60 of 66 vectors with errors: look at ...; and: set both ...". It is
/// said as a guess where it explains less than half of the vectors, and for one vector.
std::string toText(const CommonPair& pair);

/// `findings` (`fault`, `variant`, `agreement`, `advice` of each), `vectors` and `failures`.
nlohmann::ordered_json toJson(const CommonPair& pair);

/// Names stale frames: where the item IDs of a vector are those of an earlier one, in the order of `reports`.
void nameStaleFrames(std::span<Report> reports);

/// A JSON object with the keys
///
/// - `vector`, `pass`, `pixels` (a count per verdict), `faces` (the same with `name`, `width` and `height`),
/// - `errors`: `face`, `column`, `row`, `kind`, `expected`, `found`, `expected_from`, `found_from`, `triangle`, `texel`
///   (null where there is none),
/// - `diagnosis`: `fault`, `variant`, `agreement`, `advice` of each that may explain the errors,
/// - `reference`: `pixels` and `differing`; only of an exact report,
/// - `outcome` (outcomeNames), and `expected` with `result` and `reason`, null without an expectation,
/// - `device`: `failure`, `message`, `exit_code`, `signal` (null where there is none), `stderr` (its last lines); only
///   if the program of the device failed,
/// - `repetition`: `runs`, `answers` (the number of runs with the same item IDs, for each different answer),
///   `changing_pixels` (their number) and `pixels` (`face`, `column`, `row`, `runs` of the first ten); only of several
///   runs.
nlohmann::ordered_json toJson(const Report& report);

/// A JSON object for several vectors: `pass` (no result is an isFailure), `pixels` of all, `vectors` (an object as
/// above for each), and `diagnosis`: null, or `fault`, `variant`, `agreement`, `advice`, `vectors`, `failures` and
/// `weak` (isWeak) of the common fault.
nlohmann::ordered_json toJson(std::span<const Report> reports, bool isStrict = false);

/// JUnit XML, for build servers. Each vector is a test suite, each face a test case. A face with errors fails and names
/// the diagnosis; it counts as skipped where the errors are expected. A vector without verdicts is one test case: it
/// fails when it is missing or when the program of the device failed, and counts as skipped when it is unsupported.
/// With `isStrict` an unexpected pass is one more test case, which fails.
std::string toJUnit(std::span<const Report> reports, bool isStrict = false);

}  // namespace hemitex::reference
