#include "tests/pages/page_commands.h"

#include <sys/wait.h>

#include <cstdlib>
#include <regex>
#include <sstream>
#include <stdexcept>

#include "raster/base/file_io.h"

namespace hemitex::pages {
namespace {

namespace fs = std::filesystem;

const std::string commandStart = "    $ ", commandLine = "    > ", blockLine = "    ";

std::string quoted(const fs::path& path) { return "'" + path.string() + "'"; }

/// What a command prints, each line as a line of a code block.
std::string outputOf(const std::string& command, const fs::path& folder, const fs::path& programs) {
  const fs::path script = folder / "command.sh", output = folder / "output.txt";
  raster::writeFile(script, command);
  const std::string line = "cd " + quoted(folder) + " && PATH=" + quoted(programs) + ":\"$PATH\" sh " + quoted(script) +
                           " > " + quoted(output) + " 2>&1 < /dev/null";
  const int status = std::system(line.c_str());
  if (!WIFEXITED(status)) throw std::runtime_error("cannot run " + command);
  std::string text;
  std::istringstream lines(raster::readFile(output));
  for (std::string printed; std::getline(lines, printed);) {
    if (!printed.empty()) text += blockLine + printed + '\n';
  }
  if (WEXITSTATUS(status) != 0) text += blockLine + "(exit code " + std::to_string(WEXITSTATUS(status)) + ")\n";
  return text;
}

}  // namespace

std::string withOutputs(const std::string& page, const fs::path& folder, const fs::path& programs) {
  std::string written, command;
  bool isOutput = false;
  const auto run = [&] {
    if (!command.empty()) written += outputOf(command, folder, programs);
    command.clear();
  };
  std::istringstream lines(page);
  for (std::string line; std::getline(lines, line);) {
    const bool starts = line.starts_with(commandStart), continues = line.starts_with(commandLine);
    if (starts || !continues) run();
    isOutput = starts || continues || (isOutput && line.starts_with(blockLine));
    if (starts || continues) command += line.substr(commandStart.size()) + '\n';
    if (starts || continues || !isOutput) written += line + '\n';
  }
  run();
  return written;
}

std::string withoutTimes(const std::string& text) {
  return std::regex_replace(text, std::regex(R"(\d[\d.e-]* s\b)"), "# s");
}

std::vector<std::string> picturesOf(const std::string& page) {
  const std::regex picture(R"(\]\(([^)]+\.png)\))");
  std::vector<std::string> names;
  for (std::sregex_iterator match(page.begin(), page.end(), picture), end; match != end; ++match)
    names.push_back((*match)[1]);
  return names;
}

}  // namespace hemitex::pages
