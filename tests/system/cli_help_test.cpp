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

  bool has(const std::string& program) const { return execute("command -v " + program).exitCode == 0; }

  /// What bash offers for the last of these words, which need no quotes.
  std::vector<std::string> completionsOf(const std::string& words) const {
    writeAll(file("ask.bash"), "source share/bash-completion/completions/hemitex\nCOMP_WORDS=(" + words +
                                   ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_hemitex\n"
                                   "printf '%s\\n' \"${COMPREPLY[@]}\"\n");
    const Outcome outcome = execute("bash --norc -u ask.bash");
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
  REQUIRE(shell.commands().size() == 18);
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

TEST_CASE("bashCompletion offers the options of each command's help, and no other", "[cli]") {
  const ShellFiles shell;
  const std::set<std::string> everywhere = optionsOf(shell.output("--help"));
  CHECK(everywhere.count("--threads") == 1);
  CHECK(everywhere.count("--shell-files") == 0);
  for (const std::string& command : shell.commands()) {
    std::set<std::string> expected = optionsOf(shell.output(command + " --help"));
    expected.insert(everywhere.begin(), everywhere.end());
    INFO(command);
    CHECK(setOf(shell.completionsOf("hemitex " + command + " -")) == expected);
  }
}

TEST_CASE("bashCompletion offers commands, named values and files", "[cli]") {
  const ShellFiles shell;
  using Words = std::vector<std::string>;
  fs::create_directory(shell.file("a folder"));
  CHECK(shell.completionsOf("hemitex so") == Words{"solve"});
  CHECK(shell.completionsOf("hemitex vector che") == Words{"check"});
  CHECK(shell.completionsOf("hemitex -v solve --max-r") == Words{"--max-reflectance"});
  CHECK(shell.completionsOf("hemitex solve room.obj --method ''") ==
        Words{"hemicube", "single-plane", "tetrahedron", "rays"});
  CHECK(shell.completionsOf("hemitex solve --blend int") == Words{"integer-add"});
  CHECK(shell.completionsOf("hemitex solve room.o") == Words{"room.obj"});
  CHECK(shell.completionsOf("hemitex solve -o 'a f'") == Words{"a folder"});
  CHECK(shell.completionsOf("hemitex solve --texels ''") == Words{""});  // a number: no offer
  const Outcome registered =
      shell.execute("bash --norc -c 'source share/bash-completion/completions/hemitex; complete -p hemitex'");
  CHECK(registered.out == "complete -o filenames -F _hemitex hemitex\n");
}

TEST_CASE("zshCompletion and fishCompletion are scripts that their shells read", "[cli]") {
  const ShellFiles shell;
  const auto [program, file] = GENERATE(table<std::string, std::string>(
      {{"zsh", "share/zsh/site-functions/_hemitex"}, {"fish", "share/fish/vendor_completions.d/hemitex.fish"}}));
  if (!shell.has(program)) {
    WARN("skipped: " + program + " is not installed");
    return;
  }
  const Outcome outcome = shell.execute(program + " -n " + file);
  CHECK(outcome.exitCode == 0);
  CHECK(outcome.err.empty());
}

TEST_CASE("fishCompletion offers commands, options and named values", "[cli]") {
  const ShellFiles shell;
  if (!shell.has("fish")) {
    WARN("skipped: fish is not installed");
    return;
  }
  const auto offers = [&shell](const std::string& line) {
    return matches(
        shell
            .execute("HOME=$PWD fish -c \"source share/fish/vendor_completions.d/hemitex.fish; complete -C '" + line +
                     "'\"")
            .out,
        "([^\t\n]+)[^\n]*\n");
  };
  using Words = std::vector<std::string>;
  CHECK(offers("hemitex so") == Words{"solve"});
  CHECK(offers("hemitex vector che") == Words{"check"});
  CHECK(offers("hemitex solve --max-r") == Words{"--max-reflectance"});
  CHECK(offers("hemitex solve --blend int") == Words{"integer-add"});
}

TEST_CASE("manPage names every option and example of each command's help", "[cli]") {
  const ShellFiles shell;
  const std::vector<fs::path> pages = shell.pages();
  const std::vector<std::string> commands = shell.commands();
  for (std::size_t i = 0; i < pages.size(); ++i) {
    const std::string help = shell.output(commands[i] + " --help");
    const std::string page = std::regex_replace(readAll(pages[i]), std::regex(R"(\\-)"), "-");
    INFO(pages[i]);
    for (const std::string& name : optionsOf(help)) CHECK(page.find("\\fB" + name + "\\fR") != std::string::npos);
    for (const std::string& example : examplesOf(help)) CHECK(page.find('\n' + example + '\n') != std::string::npos);
  }
}

TEST_CASE("manPage is read by groff without a warning", "[cli]") {
  const ShellFiles shell;
  if (!shell.has("groff")) {
    WARN("skipped: groff is not installed");
    return;
  }
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
