/// Folders as open descriptors. No name below an open folder leads through a link: a folder of a result may come from
/// another person, and its links may lead to any place.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hemitex::cli {

/// An open file or folder, closed at the end of its scope.
class Descriptor {
 public:
  explicit Descriptor(int value = -1) : value_(value) {}
  ~Descriptor();
  Descriptor(Descriptor&& other) noexcept;
  Descriptor& operator=(Descriptor&& other) noexcept;

  int get() const { return value_; }
  bool isOpen() const { return value_ >= 0; }

 private:
  int value_;
};

/// What has a name in a folder.
struct Place {
  enum class Kind { Nothing, File, Folder, Link, Device };
  Kind kind = Kind::Nothing;
  std::filesystem::path path;  ///< of the name, or of what stands where a folder before it should be
  /// Identify a file and its content, as far as one can tell without reading it.
  std::uint64_t device = 0, inode = 0, size = 0;
  std::int64_t changed = 0;  ///< nanoseconds

  bool operator==(const Place&) const = default;
};

/// Names may lead through inner folders, as `frame-1/floor.png`, but contain no `..`.
class Folder {
 public:
  /// Opens a folder, and makes it and those above it that are missing. Throws InputError if that fails, and if a part
  /// of the path is a link. A link in the root folder is followed: systems keep /tmp or /home elsewhere.
  explicit Folder(const std::filesystem::path& path);

  const std::filesystem::path& path() const { return path_; }
  /// The path of a name, for messages and for functions that take paths.
  std::filesystem::path pathOf(const std::filesystem::path& name) const { return (path_ / name).lexically_normal(); }
  int descriptor() const { return descriptor_.get(); }

  Place placeOf(const std::filesystem::path& name) const;
  /// As open(2), never through a link. Not open if that fails; errno says why.
  Descriptor open(const std::filesystem::path& name, int flags) const;
  /// Moves a file of another folder here, to the same name, and replaces one that is here. Throws InputError.
  void take(const Folder& from, const std::filesystem::path& name) const;
  /// Removes a file, if there is one. Throws InputError.
  void remove(const std::filesystem::path& name) const;
  /// Removes the folders that the constructor made, as long as they are empty.
  void removeMade() const;

 private:
  struct Parent {
    Descriptor folder;  ///< not open if `place` says why
    Place place;
  };
  Parent parentOf(const std::filesystem::path& name, bool makes) const;

  std::filesystem::path path_;
  std::vector<std::filesystem::path> made_;  ///< outer ones first
  Descriptor descriptor_;
};

/// Whether a name of a file stays inside a folder: relative, without `..`.
bool staysInside(const std::filesystem::path& name);

}  // namespace hemitex::cli
