#include "radiosity/textures/file_names.h"

#include <unordered_map>

#include "raster/base/lower_case.h"

namespace hemitex::radiosity {
namespace {

bool isLetterOrDigit(char c) { return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9'); }

/// Independent of the locale. Replaces a leading point, which would hide the file.
std::string fileName(const std::string& name) {
  std::string result = name.substr(0, 100);
  for (char& c : result)
    if (!isLetterOrDigit(c) && c != '.' && c != '_' && c != '-') c = '_';
  if (result.empty() || result.front() == '.') result.insert(0, "_");
  return result;
}

}  // namespace

std::vector<std::string> uniqueFileNames(const std::vector<std::string>& names,
                                         const std::vector<std::string>& reserved) {
  std::unordered_map<std::string, int> taken;  // with the last suffix of each name
  for (const std::string& name : reserved) taken.emplace(name, 1);
  std::vector<std::string> result;
  for (const std::string& name : names) {
    const std::string base = fileName(name);
    std::string unique = base;
    while (!taken.emplace(raster::lowerCase(unique), 1).second)
      unique = base + "-" + std::to_string(++taken.at(raster::lowerCase(base)));
    result.push_back(unique);
  }
  return result;
}

std::vector<std::string> uniqueObjNames(const std::vector<std::string>& names) {
  std::unordered_map<std::string, int> taken;  // with the last suffix of each name
  std::vector<std::string> result;
  for (std::string base : names) {
    for (char& c : base)
      if (static_cast<unsigned char>(c) <= ' ' || c == 0x7f) c = '_';
    if (base.empty()) base = "_";
    std::string unique = base;
    while (!taken.emplace(unique, 1).second) unique = base + "~" + std::to_string(++taken.at(base));
    result.push_back(unique);
  }
  return result;
}

}  // namespace hemitex::radiosity
