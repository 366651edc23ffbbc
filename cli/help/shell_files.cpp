#include "cli/help/shell_files.h"

#include <boost/algorithm/string.hpp>
#include <sstream>

#include "raster/base/file_io.h"

namespace hemitex::cli {
namespace {

const char* const bashCompletion = R"(# Completion of PROGRAM, written by `PROGRAM --shell-files`.
_PROGRAM() {
  local current=${COMP_WORDS[COMP_CWORD]} offers
  offers=$("${COMP_WORDS[0]}" --complete "${COMP_WORDS[@]:1:COMP_CWORD}" 2>/dev/null | cut -f 1)
  if [[ $offers == '<files>' ]]; then
    mapfile -t COMPREPLY < <(compgen -f -- "$current")
  elif [[ $offers == '<scenes>' ]]; then
    mapfile -t COMPREPLY < <(compgen -d -- "$current"; compgen -f -- "$current" | grep -iE '\.(obj|gltf|glb|stl|ply|vtu|vtp|vtk|vs3)$')
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
elif [[ $offers[1] == '<scenes>' ]]; then
  _files -g '(#i)*.(obj|gltf|glb|stl|ply|vtu|vtp|vtk|vs3)(-.)'
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
    else if test "$offers" = '<scenes>'
        __fish_complete_path (commandline -ct) | string match -ri '.*(?:/|\.(?:obj|gltf|glb|stl|ply|vtu|vtp|vtk|vs3))(?:\t.*)?$'
    else
        printf '%s\n' $offers
    end
end
complete -c PROGRAM -f -a '(__PROGRAM_offers)'
)";

/// Escapes a text. A dash becomes the one of the keyboard, so that options can be copied from the page.
std::string escaped(std::string text) {
  boost::replace_all(text, "\\", "\\e");
  boost::replace_all(text, "-", "\\-");
  return text.starts_with('.') || text.starts_with('\'') ? "\\&" + text : text;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

void writeSynopsis(std::ostream& page, const CommandInfo& command) {
  page << ".SH SYNOPSIS\n" << bold(command.name);
  if (!command.commands.empty()) page << ' ' << italic("COMMAND");
  for (const OptionInfo& argument : command.arguments) {
    const std::string name = italic(argument.names.front());
    page << ' ' << (argument.isRequired ? name : '[' + name + ']');
  }
  for (const OptionInfo& option : command.options)
    if (option.isRequired) page << ' ' << bold(option.names.front()) << ' ' << italic(option.value);
  page << " [" << italic("OPTIONS") << "]\n";
}

void writeOptions(std::ostream& page, const std::string& title, const std::vector<OptionInfo>& options) {
  if (options.empty()) return;
  page << ".SH " << title << '\n';
  const bool hasTopics = options.front().topic != options.back().topic;
  std::string topic;
  for (const OptionInfo& option : options) {
    if (hasTopics && option.topic != topic) page << ".SS " << escaped(option.topic) << '\n';
    topic = option.topic;
    page << ".TP\n";
    for (std::size_t i = 0; i < option.names.size(); ++i) page << (i > 0 ? ", " : "") << bold(option.names[i]);
    const bool isArgument = !option.names.front().starts_with('-');
    if (!isArgument && !option.value.empty()) page << ' ' << italic(option.value);
    page << '\n' << escaped(option.help) << '\n';
  }
}

/// The name of the page of a command, such as `hemitex-vector-check`.
std::string manPageName(const CommandInfo& command) { return boost::replace_all_copy(command.name, " ", "-"); }

/// A manual page in the man macros of roff. It has no date, so that builds are reproducible.
std::string manPage(const CommandInfo& command, const std::string& version) {
  const std::string program = command.name.substr(0, command.name.find(' '));
  const bool isProgram = program == command.name;
  // The sentence about a program begins with its name.
  const std::string purpose = isProgram ? command.help.substr(program.size() + 1) : command.help;
  std::ostringstream page;
  page << ".TH " << boost::to_upper_copy(manPageName(command)) << " 1 \"\" \"" << program << ' ' << version
       << "\" \"User Commands\"\n.SH NAME\n"
       << escaped(manPageName(command)) << " \\- " << escaped(purpose) << '\n';
  writeSynopsis(page, command);
  if (!command.commands.empty()) page << ".SH COMMANDS\n";
  for (const CommandInfo& inner : command.commands)
    page << ".TP\n"
         << bold(inner.word()) << '\n'
         << escaped(inner.help) << ".\nSee " << bold(manPageName(inner)) << "(1).\n";
  writeOptions(page, "ARGUMENTS", command.arguments);
  writeOptions(page, "OPTIONS", command.options);
  if (isProgram)
    page << ".PP\nThese options work before and after every command.\n";
  else
    page << ".PP\nThe options of " << bold(program) << "(1) work with this command, too.\n";
  if (!command.examples.empty()) page << ".SH EXAMPLES\n.nf\n";
  for (const std::string& example : command.examples) page << escaped(example) << '\n';
  if (!command.examples.empty()) page << ".fi\n";
  page << ".SH EXIT STATUS\n0: done. 1: a comparison or verification failed. 2: the input or the usage is wrong. "
          "3: an internal error.\n";
  return page.str();
}

void write(const std::filesystem::path& file, const std::string& text, const std::string& program) {
  std::filesystem::create_directories(file.parent_path());
  raster::writeFile(file, boost::replace_all_copy(text, "PROGRAM", program));
}

/// The pages of a command and of all commands below it.
void writeManPages(const std::filesystem::path& folder, const CommandInfo& command, const std::string& version) {
  raster::writeFile(folder / (manPageName(command) + ".1"), manPage(command, version));
  for (const CommandInfo& inner : command.commands) writeManPages(folder, inner, version);
}

}  // namespace

void writeShellFiles(const std::filesystem::path& folder, const CommandInfo& program, const std::string& version) {
  write(folder / "bash-completion/completions" / program.name, bashCompletion, program.name);
  write(folder / "zsh/site-functions" / ('_' + program.name), zshCompletion, program.name);
  write(folder / "fish/vendor_completions.d" / (program.name + ".fish"), fishCompletion, program.name);
  std::filesystem::create_directories(folder / "man/man1");
  writeManPages(folder / "man/man1", program, version);
}

}  // namespace hemitex::cli
