#include "cli/common/staging.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <mutex>
#include <system_error>
#include <thread>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using raster::InputError;

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

const std::string prefix = ".hemitex.partial-";

/// The temporary folder of a result: of a folder one, of files one per file. Long names have short hashes.
std::string temporaryName(const std::string& file) {
  return prefix + (file.empty() ? "0" : reference::sha256(file).substr(0, 16));
}

/// Opens a folder in another one, but none of another user, who could put links into it.
Descriptor ownFolder(const Folder& outer, const std::string& name) {
  Descriptor folder = outer.open(name, O_RDONLY | O_DIRECTORY);
  struct stat status = {};
  if (folder.isOpen() && (fstat(folder.get(), &status) != 0 || status.st_uid != geteuid())) {
    folder = Descriptor();
    errno = EPERM;
  }
  return folder;
}

/// Locks a folder; waits at most a second for another run that has the lock.
bool locksSoon(int folder) {
  for (int look = 0; look < 100; ++look) {
    if (flock(folder, LOCK_EX | LOCK_NB) == 0) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Opens and locks a folder in another one. Not open if another run has locked it. Throws InputError if what has the
/// name is no folder of this user.
Descriptor lockedFolder(const Folder& outer, const std::string& name) {
  for (;;) {
    if (mkdirat(outer.descriptor(), name.c_str(), 0700) != 0 && errno != EEXIST)
      throw InputError(outer.path().string(), 0,
                       "is not a folder that can be written: " + std::generic_category().message(errno),
                       "choose another folder");
    Descriptor folder = ownFolder(outer, name);
    if (!folder.isOpen() && errno == ENOENT) continue;  // removed by the run that had it
    if (!folder.isOpen())
      throw InputError(outer.pathOf(name).string(), 0, "is in the way of the temporary files of this run",
                       "remove it, or choose another folder");
    // A run that looks for abandoned folders locks each for a moment.
    if (!locksSoon(folder.get())) return Descriptor();
    // Between opening and locking, such a run, or the one that had the folder, may have removed it.
    struct stat opened = {};
    if (fstat(folder.get(), &opened) == 0 && opened.st_ino == outer.placeOf(name).inode) return folder;
  }
}

/// Removes the temporary folders of runs that were killed.
void removeAbandoned(const Folder& outer, const std::string& ours) {
  std::error_code ignored;
  std::set<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(outer.path(), ignored))
    if (entry.path().filename().string().starts_with(prefix)) names.insert(entry.path().filename());
  names.erase(ours);
  for (const std::string& name : names)
    if (const Descriptor folder = ownFolder(outer, name);
        folder.isOpen() && flock(folder.get(), LOCK_EX | LOCK_NB) == 0)
      fs::remove_all(outer.path() / name, ignored);
}

bool isSameFile(const Place& place, const fs::path& file) {
  struct stat status = {};
  return stat(file.c_str(), &status) == 0 && status.st_dev == place.device && status.st_ino == place.inode;
}

[[noreturn]] void refuse(const Place& place, const std::string& problem) {
  throw InputError(place.path.string(), 0, problem, "move it, or choose another place for the result");
}

}  // namespace

Staging::Staging(const Output& output) : Staging(output, std::lock_guard(openFolders().mutex)) {}

Staging::Staging(const Output& output, const std::lock_guard<std::mutex>&)
    : output_(output),
      name_(output.kind == Output::Kind::File ? output.place.filename().string() : ""),
      final_(output.kind == Output::Kind::File ? output.place.parent_path() : output.place),
      temporary_(temporaryName(name_)) {
  const auto undo = [this] {
    if (lock_.isOpen()) rmdir(folder().c_str());
    final_.removeMade();
  };
  try {
    if (output.kind == Output::Kind::File && !staysInside(name_))
      throw InputError(output.place.string(), 0, "is a folder, not the name of a file");
    lock_ = lockedFolder(final_, temporary_);
    if (!lock_.isOpen())
      throw InputError(output.place.string(), 0, "is in use: another run writes its result there",
                       "wait for it, or choose another place");
    for (const fs::directory_entry& left : fs::directory_iterator(folder())) fs::remove_all(left);
    removeAbandoned(final_, temporary_);
    if (!output_.isOwn) record_ = OutputRecord(final_);
  } catch (const fs::filesystem_error& error) {
    undo();
    throw InputError(output.place.string(), 0, "cannot be written: " + error.code().message(), "choose another place");
  } catch (const InputError&) {
    undo();
    throw;
  }
  openFolders().folders.insert(this);
}

Staging::~Staging() {
  const std::lock_guard guard(openFolders().mutex);
  removeFiles();
  openFolders().folders.erase(this);
}

void Staging::removeFiles() const {
  std::error_code ignored;
  // At a signal, another thread may write a file into the folder between its listing and its removal.
  for (int look = 0; look < 100 && fs::exists(folder(), ignored); ++look) fs::remove_all(folder(), ignored);
  final_.removeMade();
}

Origin Staging::originOf(const std::string& name) const {
  if (output_.replaced.contains(name)) return Origin::Intact;
  if (output_.isOwn) return output_.isOwn(final_.pathOf(name)) ? Origin::Intact : Origin::Other;
  return record_.originOf(final_, name, output_.writer);
}

/// Throws InputError for a name of an input.
void Staging::requireOther(const std::string& name) const {
  const Place place = final_.placeOf(name);
  if (place.kind != Place::Kind::File || output_.replaced.contains(name)) return;
  for (const fs::path& input : output_.inputs)
    if (isSameFile(place, input)) refuse(place, "is read by this run, and its result would replace it");
}

void Staging::requirePlace(const std::string& name) {
  using Kind = Place::Kind;
  const Place place = final_.placeOf(name);
  if (place.kind == Kind::Nothing || checked_[name] == place) return;
  if (place.kind == Kind::Link) refuse(place, "is a link, and results are not written through links");
  if (place.kind == Kind::Device) refuse(place, "is a device or a pipe, not a file");
  if (place.kind == Kind::Folder) refuse(place, "is a folder, but a file of the result has this name");
  if (place.path != final_.pathOf(name)) refuse(place, "is a file, but a folder of the result has this name");
  const Origin origin = originOf(name);
  if (origin == Origin::Changed) refuse(place, "was changed since hemitex wrote it, and the result would replace it");
  if (origin == Origin::Other)
    refuse(place, "is in the way: hemitex did not write it as a part of this result, and does not replace it");
  checked_[name] = place;
}

void Staging::requirePlaces(const std::set<std::string>& names) {
  for (const std::string& name : names) requireOther(name);  // the most telling reason first
  for (const std::string& name : names) requirePlace(name);
}

const std::map<std::string, std::string>& Staging::hashes() {
  for (const fs::path& name : filesBelow(folder()))
    if (!hashes_.contains(name.string())) hashes_[name.string()] = reference::sha256OfFile(folder() / name);
  return hashes_;
}

void Staging::writeRecord() const {
  if (record_.isEmpty()) return final_.remove(recordName);
  raster::writeFile(folder() / recordName, record_.text());
  final_.take(Folder(folder()), recordName);
}

void Staging::commit(const std::string& last, const std::set<std::string>& stale) {
  const std::lock_guard guard(openFolders().mutex);  // a signal waits until the result is whole
  const Folder staged(folder());
  std::set<std::string> names;
  for (const fs::path& name : filesBelow(folder())) names.insert(name);
  requirePlaces(names);
  std::set<std::string> removed;
  for (const std::string& name : stale)
    if (!names.contains(name) && originOf(name) == Origin::Intact) removed.insert(name);
  std::map<std::string, std::string> listed;  // files without marks, which the record lists
  if (!output_.isOwn)
    for (const auto& [name, hash] : hashes())
      if (!mark(folder() / name, output_.writer, hash)) listed.emplace(name, hash);
  // A run that is killed from here on leaves only files that it could replace, with their old or new content.
  if (!listed.empty()) {
    // Another run may change the record; or the folder is the temporary one of a run that started this one, which keeps
    // its lock.
    locksSoon(final_.descriptor());
    if (!record_.isCurrent(final_)) record_ = OutputRecord(final_);
    for (const auto& [name, hash] : listed) record_.add(name, output_.writer, hash);
    writeRecord();
  }
  if (!last.empty()) final_.remove(last);
  for (const std::string& name : removed) final_.remove(name);
  for (const std::string& name : names)
    if (name != last) final_.take(staged, name);
  if (!last.empty()) final_.take(staged, last);
  for (const auto& [name, hash] : listed) record_.set(name, output_.writer, hash);
  if (last == solutionName)
    for (const std::string& name : earlierFiles()) record_.erase(name);
  try {
    if (!listed.empty()) writeRecord();
    flock(final_.descriptor(), LOCK_UN);
  } catch (const InputError&) {  // the disk is full: the record of the move lists the same files
  }
  checked_.clear();
  hashes_.clear();
}

std::set<fs::path> filesBelow(const fs::path& folder) {
  std::set<fs::path> files;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder))
    if (entry.symlink_status().type() == fs::file_type::regular) files.insert(entry.path().lexically_relative(folder));
  return files;
}

void removeTemporaryFolders() {
  openFolders().mutex.lock();  // and never unlocked
  for (const Staging* staging : openFolders().folders) staging->removeFiles();
}

}  // namespace hemitex::cli
