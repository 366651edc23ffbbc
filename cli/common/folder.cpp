#include "cli/common/folder.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <system_error>
#include <utility>

#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using raster::InputError;

constexpr int asFolder = O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC;

std::string reason(int error = errno) { return std::generic_category().message(error); }

/// What has a name in an open folder; `path` is its path.
Place placeIn(int folder, const fs::path& name, const fs::path& path) {
  struct stat status = {};
  if (fstatat(folder, name.c_str(), &status, AT_SYMLINK_NOFOLLOW) != 0) {
    if (errno == ENOENT) return {Place::Kind::Nothing, path};
    throw InputError(path.string(), 0, "cannot be looked at: " + reason());
  }
  const mode_t type = status.st_mode & S_IFMT;
  const auto kind = type == S_IFREG   ? Place::Kind::File
                    : type == S_IFDIR ? Place::Kind::Folder
                    : type == S_IFLNK ? Place::Kind::Link
                                      : Place::Kind::Device;
  return {kind,
          path,
          status.st_dev,
          status.st_ino,
          static_cast<std::uint64_t>(status.st_size),
          std::int64_t{status.st_mtim.tv_sec} * 1'000'000'000 + status.st_mtim.tv_nsec};
}

InputError notAFolder(const fs::path& path, Place::Kind kind, const fs::path& asked) {
  std::error_code ignored;
  if (kind != Place::Kind::Link)
    return InputError(asked.string(), 0, "is not a folder that can be written: " + path.string() + " is a file",
                      "choose another folder");
  return InputError(path.string(), 0, "is a link, and results are not written through links",
                    "name the folder that it leads to: " + fs::weakly_canonical(path, ignored).string());
}

/// Opens the folder of a path step by step, so that none of its parts is a link.
Descriptor openedPath(const fs::path& asked, std::vector<fs::path>& made) {
  const fs::path root = "/", absolute = fs::absolute(asked);
  fs::path path = root;
  Descriptor folder(::open("/", O_PATH | O_DIRECTORY | O_CLOEXEC));
  for (const fs::path& part : absolute.relative_path()) {
    if (part.empty() || part == ".") continue;
    const bool isInRoot = path == root;
    path /= part;
    if (mkdirat(folder.get(), part.c_str(), 0777) == 0)
      made.push_back(path);
    else if (errno != EEXIST && placeIn(folder.get(), part, path).kind == Place::Kind::Nothing)
      throw InputError(asked.string(), 0, "is not a folder that can be written: " + reason(), "choose another folder");
    Descriptor next(openat(folder.get(), part.c_str(), O_PATH | asFolder));
    if (!next.isOpen() && isInRoot)
      next = Descriptor(openat(folder.get(), part.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (!next.isOpen()) throw notAFolder(path, placeIn(folder.get(), part, path).kind, asked);
    folder = std::move(next);
  }
  return Descriptor(openat(folder.get(), ".", O_RDONLY | asFolder));
}

}  // namespace

Descriptor::~Descriptor() {
  if (isOpen()) close(value_);
}
Descriptor::Descriptor(Descriptor&& other) noexcept : value_(std::exchange(other.value_, -1)) {}
Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
  std::swap(value_, other.value_);
  return *this;
}

Folder::Folder(const fs::path& path) : path_(path.empty() ? "." : path) {
  try {
    descriptor_ = openedPath(path_, made_);
    if (!descriptor_.isOpen()) throw InputError(path_.string(), 0, "is not a folder that can be read: " + reason());
  } catch (const InputError&) {
    removeMade();
    throw;
  }
}

/// The innermost folder of a name.
Folder::Parent Folder::parentOf(const fs::path& name, bool makes) const {
  fs::path inner;
  Descriptor folder(openat(descriptor(), ".", O_PATH | asFolder));
  for (const fs::path& part : name.parent_path()) {
    inner /= part;
    if (makes) mkdirat(folder.get(), part.c_str(), 0777);
    Place place = placeIn(folder.get(), part, pathOf(inner));
    if (place.kind != Place::Kind::Folder) return {Descriptor(), place};
    folder = Descriptor(openat(folder.get(), part.c_str(), O_PATH | asFolder));
  }
  return {std::move(folder), {}};
}

Place Folder::placeOf(const fs::path& name) const {
  const Parent parent = parentOf(name, false);
  return parent.folder.isOpen() ? placeIn(parent.folder.get(), name.filename(), pathOf(name)) : parent.place;
}

Descriptor Folder::open(const fs::path& name, int flags) const {
  const Parent parent = parentOf(name, false);
  if (!parent.folder.isOpen()) return Descriptor();
  return Descriptor(openat(parent.folder.get(), name.filename().c_str(), flags | O_NOFOLLOW | O_CLOEXEC, 0666));
}

void Folder::take(const Folder& from, const fs::path& name) const {
  const Parent here = parentOf(name, true), there = from.parentOf(name, false);
  const std::string leaf = name.filename();
  if (!here.folder.isOpen() || !there.folder.isOpen() ||
      renameat(there.folder.get(), leaf.c_str(), here.folder.get(), leaf.c_str()) != 0)
    throw InputError(pathOf(name).string(), 0, "the result cannot be moved here: " + reason());
}

void Folder::remove(const fs::path& name) const {
  const Parent parent = parentOf(name, false);
  if (parent.folder.isOpen() && unlinkat(parent.folder.get(), name.filename().c_str(), 0) != 0 && errno != ENOENT)
    throw InputError(pathOf(name).string(), 0, "cannot be removed: " + reason());
}

void Folder::removeMade() const {
  std::error_code failed;
  for (auto folder = made_.rbegin(); folder != made_.rend() && !failed; ++folder) fs::remove(*folder, failed);
}

bool staysInside(const fs::path& name) {
  return !name.empty() && name.is_relative() && name.has_filename() &&
         std::none_of(name.begin(), name.end(), [](const fs::path& part) { return part == ".." || part == "."; });
}

}  // namespace hemitex::cli
