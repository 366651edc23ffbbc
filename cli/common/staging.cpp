#include "cli/common/staging.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <mutex>
#include <optional>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;

/// The temporary folders of this program. A signal may end it at any time, and it leaves none behind.
struct OpenFolders {
  std::mutex mutex;
  std::set<const Staging*> folders;
};

/// Never destroyed, because a signal may arrive until the very end.
OpenFolders& openFolders() {
  static OpenFolders& open = *new OpenFolders;
  return open;
}

/// Opens and locks a folder, which is created if it does not exist. Nothing if another run has locked it.
std::optional<int> lockedFolder(const fs::path& folder) {
  for (;;) {
    fs::create_directory(folder);
    const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0 && errno == ENOENT) continue;  // removed by the run that had it
    if (file < 0) throw fs::filesystem_error("cannot be opened", folder, {errno, std::generic_category()});
    if (flock(file, LOCK_EX | LOCK_NB) != 0) {
      close(file);
      return std::nullopt;
    }
    // Between opening and locking, the run that had the folder may have removed it.
    struct stat opened = {}, named = {};
    if (fstat(file, &opened) == 0 && stat(folder.c_str(), &named) == 0 && opened.st_ino == named.st_ino) return file;
    close(file);
  }
}

fs::path partialFolder(const fs::path& folder, int number) {
  return folder / (".hemitex.partial-" + std::to_string(number));
}

/// Removes the temporary folders that no run holds, from a number on.
void removeStaleFolders(const fs::path& folder, int number) {
  for (; fs::exists(partialFolder(folder, number)); ++number)
    if (const std::optional<int> lock = lockedFolder(partialFolder(folder, number))) {
      fs::remove_all(partialFolder(folder, number));
      close(*lock);
    }
}

/// The topmost folder of a path that does not exist; empty if all exist.
fs::path topmostMissing(fs::path folder) {
  fs::path missing;
  for (; !folder.empty() && !fs::exists(folder); folder = folder.parent_path()) missing = folder;
  return missing;
}

}  // namespace

Staging::Staging(const fs::path& folder, FolderUse use) {
  try {
    const fs::path absolute = fs::absolute(folder).lexically_normal();
    final_ = absolute.has_filename() ? absolute : absolute.parent_path();
    created_ = topmostMissing(final_);
    fs::create_directories(final_);
    std::optional<int> lock;
    int number = 0;
    for (; !lock; ++number) {
      staged_ = partialFolder(final_, number);
      lock = lockedFolder(staged_);
      if (!lock && use == FolderUse::OneRun)
        throw raster::InputError(folder.string(), 0, "is in use: another run writes its result there",
                                 "wait for it, or choose another folder with -o");
    }
    lock_ = *lock;
    for (const fs::directory_entry& left : fs::directory_iterator(staged_)) fs::remove_all(left);
    removeStaleFolders(final_, number);
  } catch (const fs::filesystem_error& error) {
    removeCreatedFolders();
    throw raster::InputError(folder.string(), 0, "is not a folder that can be written: " + error.code().message(),
                             "choose another folder with -o");
  }
  const std::lock_guard guard(openFolders().mutex);
  openFolders().folders.insert(this);
}

Staging::~Staging() {
  const std::lock_guard guard(openFolders().mutex);
  removeFiles();
  openFolders().folders.erase(this);
  close(lock_);
}

void Staging::removeFiles() const {
  std::error_code ignored;
  fs::remove_all(staged_, ignored);
  removeCreatedFolders();
}

void Staging::removeCreatedFolders() const {
  std::error_code failed;
  for (fs::path folder = final_; !created_.empty() && !failed; folder = folder.parent_path()) {
    fs::remove(folder, failed);
    if (folder == created_) return;
  }
}

void Staging::requirePlaces(const std::set<std::string>& names, const std::set<fs::path>& inputs) const {
  for (const std::string& name : names) {
    const fs::path place = final_ / name;
    std::error_code ignored;
    if (fs::is_directory(place, ignored))
      throw raster::InputError(place.string(), 0, "is a folder, but a file of the result has this name",
                               "choose another folder with -o");
    for (const fs::path& input : inputs)
      if (fs::equivalent(place, input, ignored))
        throw raster::InputError(place.string(), 0, "is read by this run, and its result would replace it",
                                 "choose another folder with -o");
  }
}

void Staging::removeOld(const fs::path& name) const {
  std::error_code ignored;
  if (!fs::is_directory(final_ / name, ignored)) fs::remove(final_ / name);
}

void Staging::commit(const std::string& last, const std::set<std::string>& stale) {
  const std::lock_guard guard(openFolders().mutex);  // a signal waits until the result is whole
  try {
    std::set<fs::path> names = filesBelow(staged_);
    if (!last.empty()) removeOld(last);
    for (const std::string& name : stale)
      if (!names.contains(name)) removeOld(name);
    names.erase(last);
    const auto move = [this](const fs::path& name) {
      fs::create_directories((final_ / name).parent_path());
      fs::rename(staged_ / name, final_ / name);
    };
    for (const fs::path& name : names) move(name);
    if (!last.empty()) move(last);
  } catch (const fs::filesystem_error& error) {
    throw raster::InputError(final_.string(), 0, "the result cannot be moved here: " + error.code().message());
  }
}

std::set<fs::path> filesBelow(const fs::path& folder) {
  std::set<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (!entry.is_directory()) files.insert(entry.path().lexically_relative(folder));
  return files;
}

void removeTemporaryFolders() {
  const std::lock_guard guard(openFolders().mutex);
  for (const Staging* staging : openFolders().folders) staging->removeFiles();
}

}  // namespace hemitex::cli
