#include "cli/help/shell_files.h"

#include "cli/help/completion.h"
#include "cli/help/man_page.h"
#include "raster/base/file_io.h"

namespace hemitex::cli {
namespace {

void write(const std::filesystem::path& file, const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  raster::writeFile(file, text);
}

}  // namespace

void writeShellFiles(const std::filesystem::path& folder, const CommandInfo& program, const std::string& version) {
  write(folder / "bash-completion/completions" / program.name, bashCompletion(program));
  write(folder / "zsh/site-functions" / ('_' + program.name), zshCompletion(program));
  write(folder / "fish/vendor_completions.d" / (program.name + ".fish"), fishCompletion(program));
  for (const CommandInfo& command : allCommands(program))
    write(folder / "man/man1" / (manPageName(command) + ".1"), manPage(command, version));
}

}  // namespace hemitex::cli
