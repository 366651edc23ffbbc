/// Help for people at a terminal: examples, suggestions for typing errors, completion scripts and manual pages.
#include <algorithm>
#include <catch2/catch.hpp>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/shell.h"

using namespace hemitex::tests;
namespace fs = std::filesystem;

namespace {

const std::string usageAdvice = "COMMAND --help` for the options";

/// A folder with the completion scripts and manual pages, in `share`.
class ShellFiles : public Shell {
 public:
  ShellFiles() { output("--shell-files share"); }

  std::vector<fs::path> pages() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(file("share/man/man1"))) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  /// All commands with their outer commands; the program itself is an empty text.
  std::vector<std::string> commands() const {
    std::vector<std::string> names;
    for (const fs::path& page : pages()) {
      std::string name = page.stem().string().substr(std::string("hemitex").size());
      std::replace(name.begin(), name.end(), '-', ' ');
      names.push_back(name.substr(name.empty() ? 0 : 1));
    }
    return names;
  }

  /// Whether there is a program that a test needs. Otherwise CTest counts the test as skipped.
  bool has(const std::string& program) const {
    const bool isInstalled = execute("command -v " + program).exitCode == 0;
    if (!isInstalled) WARN("skipped: " + program + " is not installed");
    return isInstalled;
  }

  /// Runs a line of sh in which `hemitex` is this program.
  Outcome withProgram(const std::string& line) const {
    return execute("PATH=\"$(dirname '" HEMITEX_PROGRAM "'):$PATH\"; " + line);
  }

  /// What bash completions for the last of these words, which need no quotes.
  std::vector<std::string> completionsOf(const std::string& words) const {
    writeAll(file("ask.bash"), "source share/bash-completion/completions/hemitex\nCOMP_WORDS=(" + words +
                                   ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_hemitex\n"
                                   "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    const Outcome outcome = withProgram("bash --norc -u ask.bash");
    INFO(words << '\n' << outcome.err);
    CHECK(outcome.err.empty());
    REQUIRE(outcome.exitCode == 0);
    return linesOf(outcome.out);
  }
};

std::vector<std::string> matches(const std::string& text, const std::string& pattern) {
  const std::regex regex(pattern);
  return {std::sregex_token_iterator(text.begin(), text.end(), regex, 1), std::sregex_token_iterator()};
}

std::set<std::string> setOf(const std::vector<std::string>& texts) { return {texts.begin(), texts.end()}; }

/// The names of the options that a help text lists.
std::set<std::string> optionsOf(const std::string& help) {
  std::set<std::string> names;
  for (const std::string& line : linesOf(help))
    if (std::regex_search(line, std::regex("^  -")))
      for (const std::string& name : matches(line.substr(0, 30), "(?:^  |,)(--?[a-z][a-z-]*)")) names.insert(name);
  return names;
}

/// The number of options that a help text lists; an option may have two names.
std::size_t numberOfOptions(const std::string& help) { return matches(help, "\n  (-)").size(); }

/// The examples of a help text.
std::vector<std::string> examplesOf(const std::string& help) {
  const std::size_t start = help.find("Examples:\n");
  return start == std::string::npos ? std::vector<std::string>() : matches(help.substr(start), "\n  (hemitex[^\n]*)");
}

}  // namespace

TEST_CASE("hemitex names the nearest option or command for an unknown one", "[cli]") {
  const auto [arguments, unknown, nearest] = GENERATE(table<std::string, std::string, std::string>({
      {"solve room.obj -o out --texles 4", "--texles", "--texels"},
      {"solve --texles 4 room.obj -o out", "--texles", "--texels"},
      {"solve room.obj -o out --reslution=64", "--reslution", "--resolution"},
      {"solve room.obj --outptu out", "--outptu", "--output"},
      {"solve room.obj -o out --thread 1", "--thread", "--threads"},
      {"slove room.obj -o out", "slove", "solve"},
      {"vector chekc suite --candidate drawn", "chekc", "check"},
      {"vector check suite --candidat drawn", "--candidat", "--candidate"},
      {"--jsno solve room.obj -o out", "--jsno", "--json"},
  }));
  const Outcome outcome = Shell().run(arguments);
  INFO(arguments << '\n' << outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find("`" + unknown + "` is no ") != std::string::npos);
  CHECK(outcome.err.find("similar names: `" + nearest + "`") != std::string::npos);
}

TEST_CASE("hemitex COMMAND --help ends with two examples that the command accepts", "[cli]") {
  const ShellFiles shell;
  fs::create_directory_symlink(HEMITEX_DATA, shell.file("data"));
  REQUIRE(shell.commands().size() == 24);
  for (const std::string& command : shell.commands()) {
    const std::vector<std::string> examples = examplesOf(shell.output(command + " --help"));
    INFO(command);
    REQUIRE(examples.size() == 2);
    for (const std::string& example : examples) {
      const std::string start = "hemitex" + (command.empty() ? "" : " " + command) + " ";
      CHECK(example.starts_with(start));
      // The work itself may take minutes: it is stopped. A wrong command line ends at once.
      const Outcome outcome = shell.execute("timeout 1 '" HEMITEX_PROGRAM "' " + example.substr(8));
      INFO(example << '\n' << outcome.err);
      CHECK(outcome.err.find(usageAdvice) == std::string::npos);
      // Examples without this scene go on with files of other examples or of the user.
      if (example.find("data/cornell-box.obj") != std::string::npos)
        CHECK((outcome.exitCode == 0 || outcome.exitCode == 124));
    }
  }
  CHECK(shell.run("solve data/cornell-box.obj -o lit --no-such-option").err.find(usageAdvice) != std::string::npos);
}

TEST_CASE("helpFormatter shows at most ten options of a command, and all with --help-all", "[cli]") {
  const ShellFiles shell;
  for (const std::string& command : shell.commands()) {
    INFO(command);
    const std::string help = shell.output(command + " --help");
    const std::set<std::string> first = optionsOf(help), all = optionsOf(shell.output(command + " --help-all"));
    const std::size_t shown = numberOfOptions(help), known = numberOfOptions(shell.output("--help-all " + command));
    constexpr std::size_t helpOptions = 2;
    CHECK(shown <= 10 + helpOptions);
    if (known <= 10 + helpOptions) CHECK(shown == known);
    CHECK(std::includes(all.begin(), all.end(), first.begin(), first.end()));
    const std::string rest = std::to_string(known - shown) + " more options: hemitex " + command + " --help-all\n";
    CHECK((help.find(rest) != std::string::npos) == (shown < known));
  }
}

TEST_CASE("helpFormatter groups the options by topic", "[cli]") {
  const std::string help = Shell().output("solve --help");
  const auto topicOf = [&help](const std::string& option) {
    std::string topic;
    for (const std::string& line : linesOf(help)) {
      if (line.ends_with(':')) topic = line;
      if (line.starts_with("  " + option)) return topic;
    }
    return std::string();
  };
  CHECK(topicOf("-o,--output") == "Output:");
  CHECK(topicOf("--emit") == "Light and reflectance:");
  CHECK(topicOf("--texels") == "Elements:");
  CHECK(topicOf("--resolution") == "Form factors:");
  CHECK(topicOf("--size") == "Picture:");
  CHECK(topicOf("-h,--help") == "Other:");
  CHECK(matches(help, "\n(Output):\n").size() == 1);
}

TEST_CASE("helpFormatter lists excluded options in the order of their names", "[cli]") {
  const std::string help = Shell().output("solve --help-all");
  std::size_t lists = 0;
  for (const std::string& list : matches(help, "Excludes:([^\n]*)\n")) {
    const std::vector<std::string> names = matches(list, "(--[a-z-]+)");
    INFO(list);
    CHECK(std::is_sorted(names.begin(), names.end()));
    lists += names.size() > 1;
  }
  CHECK(lists >= 3);
}

TEST_CASE("shellQuoted makes the suggested --emit a word that a shell reads back", "[cli]") {
  const Shell shell;
  writeAll(shell.file("dark.obj"),
           "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 0 1 0\nv 0 1 1\nv 1 1 1\nv 1 1 0\n"
           "g it's $HOME; done\nf 1 4 3 2\ng top\nf 5 8 7 6\n");
  const Outcome dark = shell.run("solve dark.obj -o lit");
  REQUIRE(dark.exitCode == 2);
  const std::vector<std::string> advice = matches(dark.err, "add (--emit .*) \\(largest");
  REQUIRE(advice.size() == 1);
  const Outcome lit = shell.run("solve dark.obj -o lit --texels 2 --resolution 16 --size 40x30 " + advice.front());
  INFO(advice.front() << '\n' << lit.err);
  CHECK(lit.exitCode == 0);
}

TEST_CASE("completionsFor gives bash the options of each command's help, and no other", "[cli]") {
  const ShellFiles shell;
  const std::set<std::string> everywhere = optionsOf(shell.output("--help-all"));
  CHECK(everywhere.count("--threads") == 1);
  CHECK(everywhere.count("--shell-files") == 0);
  for (const std::string& command : shell.commands()) {
    std::set<std::string> expected = optionsOf(shell.output(command + " --help-all"));
    expected.insert(everywhere.begin(), everywhere.end());
    INFO(command);
    CHECK(setOf(shell.completionsOf("hemitex " + command + " -")) == expected);
  }
}

TEST_CASE("completionsFor gives bash commands, named values and files", "[cli]") {
  const ShellFiles shell;
  using Words = std::vector<std::string>;
  fs::create_directory(shell.file("a folder"));
  for (const char* file : {"hall.glb", "hall.txt"}) writeAll(shell.file(file), "");
  CHECK(shell.completionsOf("hemitex so") == Words{"solve"});
  CHECK(shell.completionsOf("hemitex vector che") == Words{"check"});
  CHECK(shell.completionsOf("hemitex -v solve --max-r") == Words{"--max-reflectance"});
  CHECK(shell.completionsOf("hemitex solve room.obj --method ''") ==
        Words{"hemicube", "single-plane", "tetrahedron", "rays"});
  CHECK(shell.completionsOf("hemitex solve --blend int") == Words{"integer-add"});
  CHECK(shell.completionsOf("hemitex solve room.o") == Words{"room.obj"});
  CHECK(shell.completionsOf("hemitex solve -o 'a f'") == Words{"a folder"});
  CHECK(shell.completionsOf("hemitex solve hall") == Words{"hall.glb"});  // a scene
  CHECK(shell.completionsOf("hemitex solve 'a f'") == Words{"a folder"});
  CHECK(setOf(shell.completionsOf("hemitex view hall")) == std::set<std::string>{"hall.glb", "hall.txt"});
  CHECK(shell.completionsOf("hemitex solve --texels ''") == Words{""});  // a number: no offer
  const Outcome registered =
      shell.execute("bash --norc -c 'source share/bash-completion/completions/hemitex; complete -p hemitex'");
  CHECK(registered.out == "complete -o filenames -F _hemitex hemitex\n");
}

// A test that needs a program that may be missing has its own entry in CTest, by its tag.
TEST_CASE("zsh completions commands, options, named values and files", "[.zsh]") {
  const ShellFiles shell;
  if (!shell.has("zsh")) return;
  // A zsh in a pseudo-terminal completes a line, and the widget prints the line that results.
  writeAll(shell.file("ask.zsh"), R"(
zmodload zsh/zpty
zpty asked zsh -f -i
zpty -w asked 'PS1=; fpath=($PWD/share/zsh/site-functions $fpath); autoload -U compinit; compinit -u -d $PWD/dump'
zpty -w asked 'tell() { print -r -- "<<$BUFFER>>"; BUFFER= }; zle -N tell; bindkey "^X" tell; print READY'
zpty -r asked output '*READY*READY*'
zpty -w -n asked "$1"$'\t\C-X'
zpty -r asked output '*<<*>>*'
print -r -- "${${output##*<<}%%>>*}"
)");
  const auto completed = [&shell](const std::string& line) {
    const Outcome outcome = shell.withProgram("timeout 20 zsh -f ask.zsh '" + line + "'");
    INFO(line << '\n' << outcome.err);
    REQUIRE(outcome.exitCode == 0);
    return outcome.out;
  };
  CHECK(completed("hemitex so") == "hemitex solve \n");
  CHECK(completed("hemitex vector che") == "hemitex vector check \n");
  CHECK(completed("hemitex solve --max-r") == "hemitex solve --max-reflectance \n");
  CHECK(completed("hemitex solve --blend int") == "hemitex solve --blend integer-add \n");
  CHECK(completed("hemitex solve roo") == "hemitex solve room.obj \n");
}

TEST_CASE("fish completions commands, options, named values and files", "[.fish]") {
  const ShellFiles shell;
  if (!shell.has("fish")) return;
  const auto completions = [&shell](const std::string& line) {
    const Outcome outcome = shell.withProgram(
        "HOME=$PWD fish -c \"source share/fish/vendor_completions.d/hemitex.fish; complete -C '" + line + "'\"");
    INFO(line << '\n' << outcome.err);
    CHECK(outcome.err.empty());
    return matches(outcome.out, "([^\t\n]+)[^\n]*\n");
  };
  using Words = std::vector<std::string>;
  CHECK(completions("hemitex so") == Words{"solve"});
  CHECK(completions("hemitex vector che") == Words{"check"});
  CHECK(completions("hemitex solve --max-r") == Words{"--max-reflectance"});
  CHECK(completions("hemitex solve --blend int") == Words{"integer-add"});
  CHECK(completions("hemitex solve --texels ") == Words{});
  CHECK(completions("hemitex solve roo") == Words{"room.obj"});
}

TEST_CASE("hemitex --help names scenes that exist, wherever it runs", "[cli]") {
  const Shell shell;
  for (const std::string command : {"", "solve ", "formfactors ", "bench ", "tradeoff "}) {
    const std::vector<std::string> scenes = matches(shell.output(command + "--help"), "(/[^ ]*cornell-box.obj)");
    INFO(command);
    REQUIRE(!scenes.empty());
    CHECK(fs::exists(scenes.front()));
  }
}

TEST_CASE("manPage names every option and example of each command's help", "[cli]") {
  const ShellFiles shell;
  fs::create_directory_symlink(HEMITEX_DATA, shell.file("data"));
  const std::vector<fs::path> pages = shell.pages();
  const std::vector<std::string> commands = shell.commands();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const std::string help = shell.output(commands[i] + " --help-all");
    const std::string page = std::regex_replace(readAll(pages[i]), std::regex(R"(\\-)"), "-");
    INFO(pages[i]);
    for (const std::string& name : optionsOf(help)) CHECK(page.find("\\fB" + name + "\\fR") != std::string::npos);
    for (const std::string& example : examplesOf(help)) CHECK(page.find('\n' + example + '\n') != std::string::npos);
  }
}

TEST_CASE("manPage is read by groff without a warning", "[.groff]") {
  const ShellFiles shell;
  if (!shell.has("groff")) return;
  for (const fs::path& page : shell.pages()) {
    const Outcome outcome = shell.execute("groff -man -ww -Tutf8 '" + page.string() + "'");
    INFO(page << '\n' << outcome.err);
    CHECK(outcome.exitCode == 0);
    CHECK(outcome.err.empty());
    CHECK(outcome.out.size() > 500);
  }
  writeAll(shell.file("wrong.1"), ".TH WRONG 1\n.NOSUCHMACRO\n");
  CHECK(!shell.execute("groff -man -ww -Tutf8 wrong.1").err.empty());
}
