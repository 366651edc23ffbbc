/// Writes results completely or not at all. A run makes its Staging before it works, which reports a folder that cannot
/// be written. Files are written into a temporary folder and moved to their final names
/// when all of them are complete. A run that fails does not change an old result.
#pragma once

#include <filesystem>
#include <set>
#include <string>

namespace hemitex::cli {

/// Who may write into a folder at the same time.
enum class FolderUse { OneRun, SeveralRuns };

/// A temporary folder inside the folder of a result, so that a move never crosses file systems. Its lock tells other
/// runs that it is in use; the next run takes the place of one that was killed.
class Staging {
 public:
  /// Creates `folder` and its parents. Throws InputError if `folder` is a file, cannot be written, or is in use by
  /// another run with `FolderUse::OneRun`.
  explicit Staging(const std::filesystem::path& folder, FolderUse use = FolderUse::OneRun);
  /// Removes files that were not moved, and folders that were created for them.
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// The temporary folder.
  const std::filesystem::path& folder() const { return staged_; }

  /// Throws InputError if a file of the result could not be moved to its final name: where a folder has the name, or
  /// one of `inputs`. Names are relative to the folder of the result.
  void requirePlaces(const std::set<std::string>& names, const std::set<std::filesystem::path>& inputs) const;

  /// Moves the files to their final names. Files of the same names are replaced; others stay, but for `stale` ones,
  /// which are removed first. The file `last`, if there is one, says that the result is complete: its old version is
  /// removed before anything else changes, and its new one is moved last.
  void commit(const std::string& last = {}, const std::set<std::string>& stale = {});

 private:
  void removeOld(const std::filesystem::path& name) const;
  void removeFiles() const;
  void removeCreatedFolders() const;
  friend void removeTemporaryFolders();

  std::filesystem::path final_;
  std::filesystem::path created_;  ///< the topmost folder that did not exist before; empty if there is none
  std::filesystem::path staged_;
  int lock_ = -1;  ///< the open temporary folder
};

/// The files below a folder, relative to it.
std::set<std::filesystem::path> filesBelow(const std::filesystem::path& folder);

/// Removes the temporary folders of this program at once, before it ends because of a signal. Results that are being
/// moved are moved first.
void removeTemporaryFolders();

}  // namespace hemitex::cli
