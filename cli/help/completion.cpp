#include "cli/help/completion.h"

#include <algorithm>
#include <functional>
#include <sstream>

#include "cli/help/shell_quote.h"

namespace hemitex::cli {
namespace {

std::string join(const std::vector<std::string>& parts, const std::string& separator) {
  std::string text;
  for (const std::string& part : parts) text += (text.empty() ? "" : separator) + part;
  return text;
}

/// Quotes a text for fish.
std::string quotedForFish(const std::string& text) {
  std::string result = "'";
  for (const char letter : text) {
    if (letter == '\'' || letter == '\\') result += '\\';
    result += letter;
  }
  return result + '\'';
}

std::vector<std::string> namesOf(const std::vector<OptionInfo>& options) {
  std::vector<std::string> names;
  for (const OptionInfo& option : options) names.insert(names.end(), option.names.begin(), option.names.end());
  return names;
}

std::vector<std::string> wordsOf(const std::vector<CommandInfo>& commands) {
  std::vector<std::string> words;
  for (const CommandInfo& command : commands) words.push_back(command.word());
  return words;
}

bool takesPath(const CommandInfo& command) {
  return std::any_of(command.arguments.begin(), command.arguments.end(),
                     [](const OptionInfo& argument) { return argument.isPath(); });
}

/// The options that a command understands: its own and those of the program.
std::vector<OptionInfo> optionsAt(const CommandInfo& program, const CommandInfo& command) {
  std::vector<OptionInfo> options = command.options;
  const std::vector<std::string> own = namesOf(options);
  for (const OptionInfo& option : program.options)
    if (std::find(own.begin(), own.end(), option.names.front()) == own.end()) options.push_back(option);
  return options;
}

/// A pattern of `case` for all commands but the program, as full names.
std::string commandPattern(const CommandInfo& program, const std::string& separator) {
  std::vector<std::string> names;
  for (const CommandInfo& command : allCommands(program))
    if (command.name != program.name) names.push_back(shellQuoted(command.name));
  return join(names, separator);
}

/// One line of `case` per option with a value: a pattern of `COMMAND OPTION`, and what `action` makes of the option.
std::string casesOfValues(const CommandInfo& program, const std::function<std::string(const OptionInfo&)>& action) {
  std::ostringstream text;
  for (const CommandInfo& command : allCommands(program))
    for (const OptionInfo& option : optionsAt(program, command)) {
      if (option.value.empty()) continue;
      std::vector<std::string> patterns;
      for (const std::string& name : option.names) patterns.push_back(shellQuoted(command.name + ' ' + name));
      text << "    " << join(patterns, " | ") << ") " << action(option) << " ;;\n";
    }
  return text.str();
}

std::string heading(const CommandInfo& program) {
  return "# Completion of " + program.name + ", written by `" + program.name + " --shell-files`.\n";
}

/// The name of the program in names of functions.
std::string identifier(const CommandInfo& program) {
  std::string name = program.name;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

}  // namespace

std::string bashCompletion(const CommandInfo& program) {
  const auto valuesOf = [](const OptionInfo& option) -> std::string {
    if (!option.choices.empty()) return "words=(-W " + shellQuoted(join(option.choices, " ")) + ')';
    return option.isPath() ? "words=(-f)" : "words=()";
  };
  std::ostringstream text;
  text << heading(program) << '_' << identifier(program) << "() {\n  local command=" << program.name << R"( word options
  local -a words=()
  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}
  for word in "${COMP_WORDS[@]:1:COMP_CWORD-1}"; do
    case "$command $word" in
      )"
       << commandPattern(program, " | ") << R"() command="$command $word" ;;
    esac
  done
  case $command in
)";
  for (const CommandInfo& command : allCommands(program)) {
    text << "    " << shellQuoted(command.name)
         << ")\n      options=" << shellQuoted(join(namesOf(optionsAt(program, command)), " ")) << '\n';
    if (!command.commands.empty())
      text << "      words=(-W " << shellQuoted(join(wordsOf(command.commands), " ")) << ")\n";
    if (takesPath(command)) text << "      words=(-f)\n";
    text << "      ;;\n";
  }
  text << R"(  esac
  [[ $current != -* ]] || words=(-W "$options")
  case "$command $previous" in
)" << casesOfValues(program, valuesOf)
       << R"(  esac
  COMPREPLY=()
  [[ ${#words[@]} -eq 0 ]] || mapfile -t COMPREPLY < <(compgen "${words[@]}" -- "$current")
}
complete -o filenames -F _)"
       << identifier(program) << ' ' << program.name << '\n';
  return text.str();
}

std::string zshCompletion(const CommandInfo& program) {
  const auto valuesOf = [](const OptionInfo& option) -> std::string {
    if (!option.choices.empty()) return "compadd -- " + join(option.choices, " ") + "; return";
    return option.isPath() ? "_files; return" : "_message " + shellQuoted(option.value) + "; return";
  };
  std::ostringstream text;
  text << "#compdef " << program.name << '\n'
       << heading(program) << "local command=" << program.name << R"( word
local -a options commands
for word in "${(@)words[2,CURRENT-1]}"; do
  case "$command $word" in
    )" << commandPattern(program, " | ")
       << R"() command="$command $word" ;;
  esac
done
case "$command ${words[CURRENT-1]}" in
)" << casesOfValues(program, valuesOf)
       << "esac\nlocal takes_path=0\ncase $command in\n";
  for (const CommandInfo& command : allCommands(program)) {
    text << "  " << shellQuoted(command.name) << ")\n    options=(\n";
    for (const OptionInfo& option : optionsAt(program, command))
      for (const std::string& name : option.names) text << "      " << shellQuoted(name + ':' + option.help) << '\n';
    text << "    )\n    commands=(\n";
    for (const CommandInfo& inner : command.commands)
      text << "      " << shellQuoted(inner.word() + ':' + inner.help) << '\n';
    text << "    )\n    takes_path=" << takesPath(command) << "\n    ;;\n";
  }
  text << R"(esac
if [[ $PREFIX == -* ]]; then
  _describe -o option options
elif (( $#commands )); then
  _describe command commands
elif (( takes_path )); then
  _files
fi
)";
  return text.str();
}

std::string fishCompletion(const CommandInfo& program) {
  const std::string at = "__" + identifier(program) + "_command";
  std::ostringstream text;
  text << heading(program) << "# Succeeds if the command line is at this command.\nfunction " << at
       << "\n    set -l command " << program.name << R"(
    for word in (commandline -opc)[2..]
        switch "$command $word"
            case )"
       << commandPattern(program, " ") << R"(
                set command "$command $word"
        end
    end
    test "$command" = "$argv"
end
)"
       << "complete -c " << program.name << " -f\n";
  for (const CommandInfo& command : allCommands(program)) {
    const std::string start = "complete -c " + program.name + " -n " + quotedForFish(at + ' ' + command.name) + ' ';
    for (const CommandInfo& inner : command.commands)
      text << start << "-a " << inner.word() << " -d " << quotedForFish(inner.help) << '\n';
    if (takesPath(command)) text << start << "-F\n";
    for (const OptionInfo& option : optionsAt(program, command)) {
      text << start;
      for (const std::string& name : option.names)
        text << (name.starts_with("--") ? "-l " + name.substr(2) : "-s " + name.substr(1)) << ' ';
      if (!option.choices.empty())
        text << "-x -a " << quotedForFish(join(option.choices, " ")) << ' ';
      else if (!option.value.empty())
        text << (option.isPath() ? "-r -F " : "-x ");
      text << "-d " << quotedForFish(option.help) << '\n';
    }
  }
  return text.str();
}

}  // namespace hemitex::cli
