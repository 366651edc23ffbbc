/// Results appear whole or not at all: files are written under a temporary name and moved into place when all of
/// them are done. A run that fails leaves the old result, if there was one, as it was.
#pragma once

#include <filesystem>

namespace hemitex::cli {

/// A temporary folder beside the files it will become: inside the result's folder where that exists, so that a move
/// never crosses file systems, otherwise next to it.
class Staging {
 public:
  /// Throws InputError where `folder` is no folder or nothing can be written there. Parents are created.
  explicit Staging(const std::filesystem::path& folder);
  /// Removes what was not moved into place.
  ~Staging();
  Staging(const Staging&) = delete;
  Staging& operator=(const Staging&) = delete;

  /// Where to write the files.
  const std::filesystem::path& folder() const { return staged_; }
  /// Moves the files to their final names; files and folders of the same names are replaced, others stay.
  void commit();

 private:
  std::filesystem::path final_;
  std::filesystem::path staged_;
};

}  // namespace hemitex::cli
