/// Waits until files change.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>

namespace hemitex::cli {

/// The files of a scene, as they were at one time.
class WatchedFiles {
 public:
  WatchedFiles() = default;
  /// A file may be missing; it changes when it appears.
  explicit WatchedFiles(const std::set<std::filesystem::path>& files);

  /// Waits until a file has changed and none has changed for 40 ms since, so that a program has probably written all of
  /// them. Returns a changed file; nothing once `isStopping` returns true, which it asks every 20 ms.
  std::optional<std::filesystem::path> awaitChange(const std::function<bool()>& isStopping) const;

 private:
  /// The time of the last change and the size.
  using State = std::pair<std::filesystem::file_time_type, std::uintmax_t>;
  std::map<std::filesystem::path, State> states_;
};

}  // namespace hemitex::cli
