#include "radiosity/base/named_file.h"

#include <algorithm>
#include <boost/algorithm/string/case_conv.hpp>
#include <system_error>
#include <vector>

namespace hemitex::radiosity {
namespace {

bool isFile(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::exists(path, ignored) && !std::filesystem::is_directory(path, ignored);
}

/// The entry of a folder with a name in any letters; of several the first by name.
std::optional<std::filesystem::path> entryLike(const std::filesystem::path& folder, const std::filesystem::path& name) {
  std::error_code ignored;
  if (name == ".." || std::filesystem::exists(folder / name, ignored)) return folder / name;
  const std::string wanted = boost::to_lower_copy(name.string());
  std::vector<std::filesystem::path> found;
  for (auto entry = std::filesystem::directory_iterator(folder.empty() ? "." : folder, ignored);
       !ignored && entry != std::filesystem::directory_iterator(); entry.increment(ignored))
    if (boost::to_lower_copy(entry->path().filename().string()) == wanted) found.push_back(entry->path().filename());
  if (found.empty()) return std::nullopt;
  return folder / *std::min_element(found.begin(), found.end());
}

}  // namespace

std::optional<std::filesystem::path> namedFile(const std::filesystem::path& folder, std::string name) {
  if (name.size() > 1 && (name.front() == '"' || name.front() == '\'') && name.back() == name.front())
    name = name.substr(1, name.size() - 2);
  if (isFile(folder / name)) return folder / name;
  std::replace(name.begin(), name.end(), '\\', '/');
  if (isFile(folder / name)) return folder / name;
  const std::filesystem::path given = std::filesystem::path(name).lexically_normal();
  const std::vector<std::filesystem::path> parts(given.begin(), given.end());
  for (std::size_t first = 0; first < parts.size(); ++first) {
    std::optional<std::filesystem::path> path = folder;
    for (std::size_t part = first; path && part < parts.size(); ++part) path = entryLike(*path, parts[part]);
    if (path && isFile(*path)) return path;
  }
  return std::nullopt;
}

}  // namespace hemitex::radiosity
