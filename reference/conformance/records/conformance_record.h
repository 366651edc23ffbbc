/// A conformance record: which item IDs a device wrote for a suite of vectors, and what the verdict was. Anybody who
/// has the suite, and the item IDs of the device, can compute it again.
///
/// Each entry carries the SHA-256 of its own text, so that damage is found and its place is named. The record does not
/// prove who wrote it.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "reference/conformance/diagnosis/verdict_report.h"

namespace hemitex::reference {

struct RecordedFace {
  std::string name;
  std::string ids;  ///< SHA-256 of the device's item ID file
  VerdictCounts pixels{};

  bool operator==(const RecordedFace&) const = default;
};

struct RecordedVector {
  std::string name;
  std::string files;  ///< hashOfVector
  Outcome outcome = Outcome::Pass;
  std::optional<ExpectedResult> expected;
  std::vector<RecordedFace> faces;  ///< none if the device did not draw the vector
};

struct ConformanceRecord {
  int rules = 1;  ///< version of the raster rules
  std::string device, driver;
  DeviceProfile profile;
  std::vector<RecordedVector> vectors;  ///< in the order of their names
};

/// SHA-256 over names and bytes of all files directly in the folder of a vector, in the order of their names. Throws
/// InputError for a file that cannot be read.
std::string hashOfVector(const std::filesystem::path& folder);

/// The entry of a vector that lies in `folder`.
RecordedVector recordOf(const Report& report, const std::filesystem::path& folder);

/// A JSON object with `format` ("hemitex conformance record"), `version` (1) and `entries`, in this order:
///
/// - the header: `device`, `driver`, `rules`, `profile` (device_profile.h), `vectors` (their number) and `suite`
///   (SHA-256 over the hashes of the vectors),
/// - one entry per vector: `vector`, `files`, `outcome`, `expected` (null, or `result` and `reason`), and `faces` with
///   `name`, `ids` and a count per verdict.
///
/// Each entry ends with `sha256`, the hash of the entry without it, as JSON without blanks.
std::string toJson(const ConformanceRecord& record);

struct RecordFile {
  ConformanceRecord record;
  std::size_t entries = 0;
  std::vector<std::string> damage;  ///< what does not agree with its hash; empty for an intact file
};

/// Throws InputError for a file that is no record, or whose damage leaves no readable record.
RecordFile readRecord(const std::filesystem::path& file);

/// What of `found` differs from the record, one line each; empty if they agree. Without faces in `found`, only the
/// files of the vector are compared.
std::vector<std::string> differences(const RecordedVector& recorded, const RecordedVector& found);

}  // namespace hemitex::reference
