/// Runs the built hemitex program as a script does.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace hemitex::tests {

/// The bytes of a file, which must exist.
std::string readAll(const std::filesystem::path& file);
void writeAll(const std::filesystem::path& file, const std::string& text);

struct Outcome {
  int exitCode;
  std::string out, err;
};

/// Runs `hemitex ARGUMENTS` in a folder of its own with a small scene, `room.obj`.
class Shell {
 public:
  Shell();

  Outcome run(const std::string& arguments) const;
  /// Runs a line of `sh` in the folder.
  Outcome execute(const std::string& line) const;
  /// As run, but requires success. Returns the standard output.
  std::string output(const std::string& arguments) const;

  std::filesystem::path file(const std::string& name) const { return folder_.path / name; }

  /// All files below the folder, with their content.
  std::map<std::string, std::string> files() const;

 private:
  TemporaryFolder folder_, streams_;
};

/// How a line of `sh` starts hemitex.
inline const std::string program = "'" HEMITEX_PROGRAM "' ";

/// A solve command of the scene; the output folder is missing.
inline const std::string quickSolve = "solve room.obj --texels 4 --patch 2 --resolution 32 --size 40x30 ";

std::vector<std::string> linesOf(const std::string& text);

/// The last field of a CSV line.
double lastNumber(const std::string& line);

}  // namespace hemitex::tests
