/// The rule for all that hemitex writes: completely or not at all, and never over what is not its own.
///
/// A run makes its Staging before it works, which reports a place that cannot be written. Files are written into a
/// temporary folder and moved to their final names when all of them are complete. A run that fails does not change an
/// old result. A file that is there already is replaced only if the same writer wrote it and it was not changed since
/// (see OutputRecord); an input of the run, a link, a device and a folder are never replaced.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "cli/common/folder.h"
#include "cli/common/output_record.h"

namespace hemitex::cli {

/// Where a run writes, and what it may replace there.
struct Output {
  enum class Kind { Folder, File };
  Kind kind = Kind::Folder;
  std::filesystem::path place;  ///< of the folder or file
  std::string writer;           ///< the command, and for one file of several the option, such as `render`
  std::set<std::filesystem::path> inputs = {};  ///< the files that the run reads; see Context::inputs
  std::set<std::string> replaced = {};          ///< names in the folder that are replaced in any case
  /// Tells a file of this kind from others by its content; then no record is kept. Empty: the record tells.
  std::function<bool(const std::filesystem::path&)> isOwn = {};
};

/// A temporary folder inside the folder of a result, so that a move never crosses file systems. Its lock tells other
/// runs that the result is being written; the next run takes the place of one that was killed.
class Staging {
 public:
  /// Makes the folder of the result and those above it. Throws InputError if it cannot be written, if a part of the
  /// path is a link, or if another run writes the same result.
  explicit Staging(const Output& output);
  /// Removes files that were not moved, and folders that were made for them.
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// The temporary folder.
  std::filesystem::path folder() const { return final_.pathOf(temporary_); }
  /// Where a result that is one file is written.
  std::filesystem::path file() const { return folder() / name_; }
  /// The folder of the result.
  const Folder& place() const { return final_; }

  /// Throws InputError if a file of the result could not be moved to its final name, and names what is in the way.
  /// Names are relative to the folder of the result. `commit` checks again, so this only saves work in vain.
  void requirePlaces(const std::set<std::string>& names);

  /// The files of an earlier result of the same writer.
  std::set<std::string> earlierFiles() const { return record_.filesOf(output_.writer); }

  /// The SHA-256 of each file that was written, by its name. Each file is read once: write no file again after it.
  const std::map<std::string, std::string>& hashes();

  /// Moves the files to their final names. Other files stay, but for those of an earlier result that are `stale`,
  /// which are removed. The file `last`, if there is one, says that the result is complete: its old version is removed
  /// before anything else changes, and its new one is moved last.
  void commit(const std::string& last = {}, const std::set<std::string>& stale = {});

 private:
  /// With the lock of the list of these folders, because a signal must not end the program before the list has this
  /// one.
  Staging(const Output& output, const std::lock_guard<std::mutex>& listIsLocked);
  void requireOther(const std::string& name) const;
  void requirePlace(const std::string& name);
  Origin originOf(const std::string& name) const;
  void writeRecord() const;
  void removeFiles() const;
  friend void removeTemporaryFolders();

  Output output_;
  std::string name_;  ///< of the file of the result; empty for a folder
  Folder final_;
  std::string temporary_;                 ///< the name of the temporary folder
  Descriptor lock_;                       ///< the open temporary folder
  OutputRecord record_;                   ///< of the folder; empty if files tell themselves from others
  std::map<std::string, Place> checked_;  ///< what may be replaced, as it was looked at
  std::map<std::string, std::string> hashes_;
};

/// The files below a folder, relative to it, but no links or devices.
std::set<std::filesystem::path> filesBelow(const std::filesystem::path& folder);

/// Removes the temporary folders of this program at once, before it ends because of a signal. Results that are being
/// moved are moved first. After it, a thread that makes, moves or removes such a folder waits for the end.
void removeTemporaryFolders();

}  // namespace hemitex::cli
