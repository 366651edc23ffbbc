/// The rows of a matrix of form factors as lines of text. They go from rank to rank, and into a file from which an
/// interrupted run continues.
#pragma once

#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "cli/common/staging.h"
#include "reference/truth/rows/scene_rows.h"

namespace hemitex::cli {

/// A row as one line of JSON, in full precision, without a line end.
std::string lineOf(const reference::Row& row);
/// Reads what lineOf wrote.
reference::Row rowOf(const std::string& line);

/// A file `OUTPUT.part` with the rows that are complete, one line per row behind a line that names the computation.
/// Each line ends with the hash of its text, so that the tail of a file that was being written is recognized.
class RowFile {
 public:
  /// Continues the file, or starts it if there is none. `computation` identifies scene and settings in one line.
  /// `inputs` are the files that the run reads, and `companions` the names of files that it writes beside the result.
  /// Throws InputError if a file cannot be written, if the result would replace an input, if another run writes the
  /// same result, or if the rows belong to another computation.
  RowFile(const std::filesystem::path& output, const std::vector<std::filesystem::path>& inputs,
          const std::string& computation, const std::set<std::string>& companions = {});
  ~RowFile();
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Calls `take` with each row that the file held when it was opened. Call it before `append`.
  void replay(const std::function<void(const std::string& line)>& take);
  /// The number of these rows.
  std::size_t rows() const { return rows_; }
  /// Whether the end of the file was damaged, so that it was dropped.
  bool wasDamaged() const { return wasDamaged_; }
  /// Appends a row. Throws InputError if it cannot be written.
  void append(const std::string& line);
  /// Where the result is written before it has its final name, and files beside it.
  std::filesystem::path staged() const { return staging_.folder() / name_; }
  /// Gives the result, and the files beside it, their final names, and removes the file of rows. The file `last`, if
  /// there is one, says that the others are complete.
  void finish(const std::string& last = {});

 private:
  void lock();
  void findIntactRows(const std::string& computation);

  Staging staging_;
  std::string name_;  ///< of the result
  std::filesystem::path part_;
  int lock_ = -1;
  std::size_t rows_ = 0;
  bool wasDamaged_ = false;
  std::ofstream stream_;
};

}  // namespace hemitex::cli
