/// Which files hemitex wrote. A run replaces and removes only files of the same writer whose content is still the one
/// that was written.
///
/// Each file has a mark, an extended attribute with its writer and its SHA-256. Some file systems and archives keep
/// none. So the record of a folder counts too: its solution.json, and `.hemitex.json`, which lists files whose mark
/// could not be written.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "cli/common/folder.h"

namespace hemitex::cli {

inline const std::string recordName = ".hemitex.json";
inline const std::string solutionName = "solution.json";
/// The writer of a solved folder.
inline const std::string solveWriter = "solve";

/// Whether a file of a solved folder has times in it, so that its hash is not kept.
bool hasTimes(const std::filesystem::path& name);

/// The object `files` of the text of a solution.json: a hash or null per name. Empty if the text is none of ours.
nlohmann::ordered_json filesOfSolution(const std::string& text);

/// Marks a file that is complete. Returns whether its file system keeps such marks.
bool mark(const std::filesystem::path& file, const std::string& writer, const std::string& hash);

enum class Origin { Other, Changed, Intact };  ///< Changed: by others, since the writer wrote it

class OutputRecord {
 public:
  /// Reads the record of a folder, with what its solution.json says. Throws InputError if a record is there that
  /// hemitex did not write, or that is no file.
  explicit OutputRecord(const Folder& folder);
  OutputRecord() = default;

  /// Whether the record in the folder is still the one that was read.
  bool isCurrent(const Folder& folder) const;

  /// Where a file of the folder is from, seen by a writer.
  Origin originOf(const Folder& folder, const std::string& name, const std::string& writer) const;
  /// The names of the files of a writer.
  std::set<std::string> filesOf(const std::string& writer) const;

  /// Also allows the content with this SHA-256: from the start of a move until its end, a name has its old content or
  /// its new one.
  void add(const std::string& name, const std::string& writer, const std::string& hash);
  /// Allows this content alone.
  void set(const std::string& name, const std::string& writer, const std::string& hash);
  void erase(const std::string& name) { entries_.erase(name); }

  bool isEmpty() const { return entries_.empty(); }
  std::string text() const;

 private:
  struct Entry {
    std::string writer;
    std::set<std::string> hashes;  ///< an empty one stands for any content
  };
  bool isListed(const std::string& name, const std::string& writer) const;
  void readRecord(const Folder& folder);
  void readSolution(const Folder& folder);

  std::array<Place, 2> read_;             ///< the two files
  std::map<std::string, Entry> entries_;  ///< by name
};

}  // namespace hemitex::cli
