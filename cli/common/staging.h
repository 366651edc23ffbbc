/// Writes results completely or not at all. Files are written into a temporary folder and moved to their final names
/// when all of them are complete. A run that fails does not change an old result.
#pragma once

#include <filesystem>

namespace hemitex::cli {

/// A temporary folder for the files of a result. It is inside the folder of the result if that exists, else beside it,
/// so that a move never crosses file systems.
class Staging {
 public:
  /// Creates the parents of `folder`. Throws InputError if `folder` is a file or cannot be written.
  explicit Staging(const std::filesystem::path& folder);
  /// Removes files that were not moved.
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// The temporary folder.
  const std::filesystem::path& folder() const { return staged_; }
  /// Moves the files to their final names. Files and folders of the same names are replaced; others stay.
  void commit();

 private:
  std::filesystem::path final_;
  std::filesystem::path staged_;
};

}  // namespace hemitex::cli
