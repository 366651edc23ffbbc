#include "cli/watch/watched_files.h"

#include <chrono>
#include <thread>
#include <utility>

namespace hemitex::cli {
namespace {

constexpr std::chrono::milliseconds interval{20};
constexpr int quietIntervals = 2;

}  // namespace

WatchedFiles::WatchedFiles(const std::set<std::filesystem::path>& files) {
  for (const std::filesystem::path& file : files) {
    std::error_code isMissing;
    const auto time = std::filesystem::last_write_time(file, isMissing);
    const std::uintmax_t size = std::filesystem::file_size(file, isMissing);
    states_[file] = isMissing ? State() : State(time, size);
  }
}

std::optional<std::filesystem::path> WatchedFiles::awaitChange(const std::function<bool()>& isStopping) const {
  std::set<std::filesystem::path> files;
  for (const auto& [file, state] : states_) files.insert(file);
  std::map<std::filesystem::path, State> last = states_;
  int quiet = 0;
  while (!isStopping()) {
    std::this_thread::sleep_for(interval);
    std::map<std::filesystem::path, State> now = WatchedFiles(files).states_;
    quiet = now == last ? quiet + 1 : 0;
    last = std::move(now);
    if (quiet < quietIntervals) continue;
    for (const auto& [file, state] : last)
      if (state != states_.at(file)) return file;
  }
  return std::nullopt;
}

}  // namespace hemitex::cli
