/// Expected results of a device on a suite: known failures, vectors that the device cannot draw, and vectors that pass
/// only sometimes. A build server compares each run with them, so that only news fails the build.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>

#include "reference/conformance/vectors/enum_names.h"

namespace hemitex::reference {

enum class Expectation : std::uint8_t {
  Fail,         ///< the vector has errors, or the device fails; without errors it is an unexpected pass
  Unsupported,  ///< the device cannot draw the vector; it is not judged and may be missing
  Flaky,        ///< the vector passes or has errors
};

constexpr std::array<Named<Expectation>, 3> expectationNames{
    {{Expectation::Fail, "fail"}, {Expectation::Unsupported, "unsupported"}, {Expectation::Flaky, "flaky"}}};

/// A line of the file.
struct ExpectedResult {
  std::string vector;
  Expectation expectation = Expectation::Fail;
  std::string reason;
};

/// By the name of the vector. All other vectors are expected to pass.
using Expectations = std::map<std::string, ExpectedResult>;

/// Reads lines `NAME fail|unsupported|flaky REASON`. Blank lines and lines that begin with # are comments. Throws
/// InputError with file and line for an unknown word, a name that is not in `vectors`, a name that appears twice, and
/// a line without a reason.
Expectations readExpectations(const std::filesystem::path& file, std::span<const std::string> vectors);

/// What happened to a vector.
enum class Outcome : std::uint8_t {
  Pass,              ///< no errors
  Errors,            ///< error pixels
  Missing,           ///< no item buffers of the device
  DeviceFailed,      ///< the program of the device crashed, hung or wrote no item buffers
  NotDeterministic,  ///< several runs with different item IDs
  NotJudged,         ///< unsupported
};

/// In the order of the enum.
constexpr std::array<Named<Outcome>, 6> outcomeNames{{{Outcome::Pass, "pass"},
                                                      {Outcome::Errors, "errors"},
                                                      {Outcome::Missing, "missing"},
                                                      {Outcome::DeviceFailed, "device failed"},
                                                      {Outcome::NotDeterministic, "not deterministic"},
                                                      {Outcome::NotJudged, "not judged"}}};

/// An outcome compared with its expectation.
enum class Agreement : std::uint8_t { AsExpected, UnexpectedFailure, UnexpectedPass };

/// `fail` and `flaky` also cover a program that failed. A missing vector is a failure with any expectation except
/// `unsupported`: nothing is known of the device.
Agreement compare(Outcome outcome, const std::optional<ExpectedResult>& expected);

/// "expected to fail: the driver rounds down", "unsupported: ..." or "flaky: ...".
std::string toText(const ExpectedResult& expected);

}  // namespace hemitex::reference
