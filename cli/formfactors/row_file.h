/// The rows of a matrix of form factors as lines of text: what ranks send, and a file from which an interrupted run
/// continues.
#pragma once

#include <cstdio>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "cli/common/staging.h"
#include "reference/matrices/sparse_row.h"

namespace hemitex::cli {

/// A row as one line of JSON, in full precision, without a line end.
std::string lineOf(const reference::SparseRow& row);
/// Reads what lineOf wrote; nothing if the text has another form.
std::optional<reference::SparseRow> rowOf(std::string_view line);

/// A line of a file of rows: the number of the row, the row, and the hash of both, with a line end.
std::string numberedLine(std::size_t number, const std::string& row);
/// The row of such a line without its end; nothing if the line is damaged, has another number, or is no row of a square
/// matrix with this number of receivers: columns ascend, all numbers are finite, form factors and errors are not
/// negative but for rounding, and all shares add up to 1 unless blockers are ignored.
std::optional<reference::SparseRow> numberedRow(std::string_view line, std::size_t number, std::size_t receivers);

/// What identifies the computation of a matrix.
struct Computation {
  std::string version;  ///< of hemitex
  std::string hash;     ///< of scene and settings
};

/// A file `OUTPUT.part` with the rows that are complete, one numbered line per row behind a line that names the version
/// and the computation. The hash of each line tells the tail of a file that was being written.
class RowFile {
 public:
  /// Continues the file, or starts it if there is none. `output` is the result, a file, and `companions` are names of
  /// files that are written beside it. Throws InputError if a file cannot be written (see Staging), or if the rows
  /// belong to another version or computation.
  RowFile(const Output& output, const Computation& computation, const std::set<std::string>& companions = {});
  RowFile(const RowFile&) = delete;
  RowFile& operator=(const RowFile&) = delete;

  /// Gives the rows that the file held when it was opened to `take`, in their order. Drops the first damaged one and
  /// all behind it. Call it once, before `append`. Returns whether rows were dropped.
  bool replay(std::size_t receivers, const std::function<void(reference::SparseRow)>& take);
  /// Gives all rows of the file to `take` once more, in their order. Throws InputError if the file has changed.
  void reread(std::size_t receivers, const std::function<void(reference::SparseRow)>& take);
  /// The number of rows in the file.
  std::size_t rows() const { return rows_; }
  /// Appends a row. Throws InputError if it cannot be written.
  void append(const reference::SparseRow& row);

  /// Where the result is written before it has its final name, with the files beside it.
  Staging& staging() { return staging_; }
  /// Gives the result, and the files beside it, their final names, and removes the file of rows. The file `last`, if
  /// there is one, says that the others are complete.
  void finish(const std::string& last = {});

 private:
  void write(const std::string& line);
  std::string nextLine();
  void cutFrom(long place);

  Staging staging_;
  std::string part_;  ///< the name of the file
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
  std::size_t rows_ = 0;
};

}  // namespace hemitex::cli
