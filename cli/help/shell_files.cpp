#include "cli/help/shell_files.h"

#include <boost/algorithm/string.hpp>

#include "cli/help/man_page.h"
#include "raster/base/file_io.h"

namespace hemitex::cli {
namespace {

const char* const bashCompletion = R"(# Completion of PROGRAM, written by `PROGRAM --shell-files`.
_PROGRAM() {
  local current=${COMP_WORDS[COMP_CWORD]} offers
  offers=$("${COMP_WORDS[0]}" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null | cut -f 1)
  if [[ $offers == '<files>' ]]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  else
    mapfile -t COMPREPLY < <(compgen -W "$offers" -- "$current")
  fi
}
complete -o filenames -F _PROGRAM PROGRAM
)";

const char* const zshCompletion = R"(#compdef PROGRAM
# Completion of PROGRAM, written by `PROGRAM --shell-files`.
local -a offers=("${(@f)$("${words[1]}" --complete "${(@)words[2,CURRENT]}" 2>/dev/null)}")
if [[ $offers[1] == '<files>' ]]; then
  _files
else
  local -a described=("${(@)${(@)offers//:/\\:}/$'\t'/:}")
  _describe offer described
fi
)";

const char* const fishCompletion = R"(# Completion of PROGRAM, written by `PROGRAM --shell-files`.
function __PROGRAM_offers
    set -l words (commandline -opc)
    set -l offers ($words[1] --complete $words[2..] (commandline -ct) 2>/dev/null)
    if test "$offers" = '<files>'
        __fish_complete_path (commandline -ct)
    else
        printf '%s\n' $offers
    end
end
complete -c PROGRAM -f -a '(__PROGRAM_offers)'
)";

void write(const std::filesystem::path& file, const std::string& text, const std::string& program) {
  std::filesystem::create_directories(file.parent_path());
  raster::writeFile(file, boost::replace_all_copy(text, "PROGRAM", program));
}

}  // namespace

void writeShellFiles(const std::filesystem::path& folder, const CommandInfo& program, const std::string& version) {
  write(folder / "bash-completion/completions" / program.name, bashCompletion, program.name);
  write(folder / "zsh/site-functions" / ('_' + program.name), zshCompletion, program.name);
  write(folder / "fish/vendor_completions.d" / (program.name + ".fish"), fishCompletion, program.name);
  for (const CommandInfo& command : allCommands(program))
    write(folder / "man/man1" / (manPageName(command) + ".1"), manPage(command, version), program.name);
}

}  // namespace hemitex::cli
