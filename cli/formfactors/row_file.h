/// The rows of a matrix of form factors as lines of text. They go from rank to rank, and into a file from which an
/// interrupted run continues.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "cli/common/staging.h"
#include "cli/formfactors/methods.h"

namespace hemitex::cli {

/// A row as one line of JSON, in full precision, without a line end.
std::string lineOf(const Row& row);
/// Reads what lineOf wrote.
Row rowOf(const std::string& line);

/// A file `OUTPUT.part` with the rows that are complete, one line per row behind a line that names the computation.
/// Each line ends with the hash of its text, so that the tail of a file that was being written is recognized.
class RowFile {
 public:
  /// Continues the file, or starts it if there is none. `computation` identifies scene and settings in one line.
  /// `inputs` are the files that the run reads. Throws InputError if a file cannot be written, if the result would
  /// replace an input, if another run writes the same result, or if the rows belong to another computation.
  RowFile(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
          const std::string& computation);
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// The rows that the file held when it was opened.
  const std::vector<std::string>& rows() const { return rows_; }
  /// Whether the end of the file was damaged, so that it was dropped.
  bool wasDamaged() const { return wasDamaged_; }
  /// Appends a row. Throws InputError if it cannot be written.
  void append(const std::string& line);
  /// Writes the result under its final name, and removes the file of rows.
  void finish(const std::string& result);

 private:
  void lock();
  void read(const std::string& computation);

  Staging staging_;
  std::string name_;  ///< of the result
  std::filesystem::path part_;
  int lock_ = -1;
  std::vector<std::string> rows_;
  bool wasDamaged_ = false;
  std::ofstream stream_;
};

}  // namespace hemitex::cli
