/// Files for the functions that read and write them, in Emscripten's file system, which is in memory.
#pragma once

#include <filesystem>
#include <string>

#include "web/bindings/values.h"

namespace hemitex::web {

/// A folder that is removed at the end. There is at most one at a time.
class Folder {
 public:
  explicit Folder(const std::string& name = "input");
  /// With the files of an object of JavaScript: strings or Uint8Arrays by their names. Throws InputError for a name
  /// that is none of a file.
  explicit Folder(const Value& files);
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hemitex::web
