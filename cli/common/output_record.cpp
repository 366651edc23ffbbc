#include "cli/common/output_record.h"

#include <fcntl.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <optional>

#include "cli/common/json.h"
#include "raster/base/input_error.h"
#include "reference/base/hashes/sha256.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;
using raster::InputError;

/// The text of a file; nothing if there is none.
std::optional<std::string> textOf(const Folder& folder, const std::string& name) {
  const Descriptor file = folder.open(name, O_RDONLY | O_NONBLOCK);
  if (!file.isOpen()) return std::nullopt;
  std::string text;
  std::array<char, 1 << 16> block;
  for (ssize_t got; (got = read(file.get(), block.data(), block.size())) > 0;)
    text.append(block.data(), static_cast<std::size_t>(got));
  return text;
}

/// Leaves out all members of the outermost object but `files`: a million surfaces would take gigabytes.
bool isOfFiles(int depth, ordered_json::parse_event_t event, ordered_json& parsed) {
  return depth != 1 || event != ordered_json::parse_event_t::key || parsed == "files";
}

/// The mark of a file holds its hash and its writer.
constexpr const char* markName = "user.hemitex";

struct Mark {
  std::string writer, hash;
};

/// The mark of an open file; empty if it has none.
Mark markOf(const Descriptor& file) {
  std::array<char, 1024> text;
  const ssize_t size = fgetxattr(file.get(), markName, text.data(), text.size());
  if (size <= static_cast<ssize_t>(reference::sha256Digits)) return {};
  const std::string mark(text.data(), static_cast<std::size_t>(size));
  return {mark.substr(reference::sha256Digits), mark.substr(0, reference::sha256Digits)};
}

}  // namespace

bool mark(const fs::path& file, const std::string& writer, const std::string& hash) {
  const std::string text = hash + writer;
  return lsetxattr(file.c_str(), markName, text.data(), text.size(), 0) == 0;
}

bool hasTimes(const fs::path& name) { return name.filename() == solutionName || name.filename() == "report.html"; }

ordered_json filesOfSolution(const std::string& text) {
  try {
    const auto solution = reference::parseJson<ordered_json>(text, {}, isOfFiles);
    const ordered_json files = solution.is_object() ? solution.value("files", ordered_json()) : ordered_json();
    return files.is_object() ? files : ordered_json::object();
  } catch (const InputError&) {  // no file of ours
    return ordered_json::object();
  }
}

OutputRecord::OutputRecord(const Folder& folder) : read_{folder.placeOf(solutionName), folder.placeOf(recordName)} {
  readSolution(folder);
  readRecord(folder);
}

bool OutputRecord::isCurrent(const Folder& folder) const {
  return read_ == std::array{folder.placeOf(solutionName), folder.placeOf(recordName)};
}

void OutputRecord::readSolution(const Folder& folder) {
  if (read_[0].kind != Place::Kind::File) return;
  const ordered_json files = filesOfSolution(textOf(folder, solutionName).value_or(""));
  for (const auto& [name, hash] : files.items())
    if (staysInside(name) && (hash.is_string() || hasTimes(name)))
      set(name, solveWriter, hash.is_string() ? hash.get<std::string>() : "");
  if (!files.empty()) set(solutionName, solveWriter, "");
}

void OutputRecord::readRecord(const Folder& folder) {
  const Place& place = read_[1];
  if (place.kind == Place::Kind::Nothing) return;
  const std::string advice = "move it, or choose another folder";
  if (place.kind != Place::Kind::File) throw InputError(place.path.string(), 0, "is not a file of hemitex", advice);
  try {
    const auto record = reference::parseJson<ordered_json>(textOf(folder, recordName).value_or(""));
    for (const auto& [name, entry] : record.at("files").items())
      for (const ordered_json& hash : entry.at("sha256"))
        if (staysInside(name)) add(name, entry.at("writer").get<std::string>(), hash.get<std::string>());
  } catch (const std::exception&) {
    throw InputError(place.path.string(), 0, "is not a record of the files that hemitex wrote", advice);
  }
}

bool OutputRecord::isListed(const std::string& name, const std::string& writer) const {
  const auto entry = entries_.find(name);
  return entry != entries_.end() && entry->second.writer == writer;
}

Origin OutputRecord::originOf(const Folder& folder, const std::string& name, const std::string& writer) const {
  if (folder.placeOf(name).kind != Place::Kind::File) return Origin::Other;
  const Descriptor file = folder.open(name, O_RDONLY | O_NONBLOCK);
  if (!file.isOpen()) return Origin::Other;
  std::set<std::string> hashes;
  if (isListed(name, writer)) hashes = entries_.at(name).hashes;
  if (const Mark mark = markOf(file); mark.writer == writer) hashes.insert(mark.hash);
  if (hashes.empty()) return Origin::Other;
  if (hashes.contains("")) return Origin::Intact;
  const std::string hash = reference::sha256OfFile("/proc/self/fd/" + std::to_string(file.get()));
  return hashes.contains(hash) ? Origin::Intact : Origin::Changed;
}

std::set<std::string> OutputRecord::filesOf(const std::string& writer) const {
  std::set<std::string> names;
  for (const auto& [name, entry] : entries_)
    if (entry.writer == writer) names.insert(name);
  return names;
}

void OutputRecord::add(const std::string& name, const std::string& writer, const std::string& hash) {
  if (!isListed(name, writer)) entries_[name] = {writer, {}};
  entries_[name].hashes.insert(hash);
}

void OutputRecord::set(const std::string& name, const std::string& writer, const std::string& hash) {
  entries_[name] = {writer, {hash}};
}

std::string OutputRecord::text() const {
  ordered_json files = ordered_json::object();
  for (const auto& [name, entry] : entries_) files[name] = {{"writer", entry.writer}, {"sha256", entry.hashes}};
  return toText({{"files", files}});
}

}  // namespace hemitex::cli
