/// Everything that the program writes, by the rule of cli/common/staging.h: each option that writes, from the list of
/// the program itself, is tried with what must never be replaced or followed.
#include <unistd.h>

#include <catch2/catch.hpp>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/shell.h"

using namespace hemitex::tests;
using Catch::Matchers::Contains;

namespace {

/// How an option that writes is tried.
struct Writer {
  std::string name;  ///< of the file or folder that stands for OUT in the command
  std::string command;
  std::string file;   ///< a file that it writes in the folder OUT; empty if OUT is a file
  std::string input;  ///< a file that it reads and that could be written; empty if there is none
  bool ends = true;   ///< whether a success ends within seconds
};

const std::string shortSolve = "solve room.obj --texels 2 --patch 2 --resolution 16 --shots 1 --size 8x6 ";
const std::string watch = "watch room.obj --texels 2 --patch 2 --resolution 16 --shots 1 --size 8x6 ";
const std::string check = "vector check v --candidate v --profile p.json ";
const std::string named = "--device-name d --driver d ";
const std::string run = "vector run v --device 'cp v/front.u32 {output}' --profile p.json ";
const std::string wrongRun = "vector run v --device 'cp wrong/front.u32 {output}' ";
const std::string facets = "--all --facets --resolution 16 ";

/// By the words of `--written-options`: the command and the option.
const std::map<std::string, Writer> writers{
    {"hemitex ", {"out", "--shell-files OUT", "man/man1/hemitex.1", ""}},
    {"hemitex solve -o,--output", {"out", shortSolve + "-o OUT", "scene.mtl", "out/scene.obj"}},
    {"hemitex solve --checkpoint", {"out", shortSolve + "-o lit --checkpoint OUT", "", "room.mtl"}},
    {"hemitex watch -o,--output", {"out", watch + "-o OUT", "scene.mtl", "out/scene.obj", false}},
    {"hemitex render -o,--output", {"out.png", "render mapped.obj --size 8x6 -o OUT", "", "map.png"}},
    {"hemitex formfactors -o,--output",
     {"out", "formfactors room.obj --all --by-surface --resolution 16 -o OUT", "", "room.mtl"}},
    {"hemitex formfactors --vtu", {"out.vtu", "formfactors box.vtu " + facets + "-o G.npz --vtu OUT", "", "box.vtu"}},
    {"hemitex matrix compare --vtu", {"out.vtu", "matrix compare F.csv F.csv box.vtu --vtu OUT", "", "box.vtu"}},
    {"hemitex matrix smooth -o,--output", {"out.csv", "matrix smooth F.csv box.vtu -o OUT", "", "box.vtu"}},
    {"hemitex tradeoff -o,--output",
     {"out", "tradeoff room.obj --texels 1 --patch 1 --samples 128 --method hemicube=16 -o OUT", "tradeoff.csv", ""}},
    {"hemitex paper -o,--output", {"out", "paper -o OUT", "", "", false}},
    {"hemitex bench -o,--output", {"out", "bench room.obj --resolution 16 -o OUT", "tables.md", "", false}},
    {"hemitex vector export -o,--output",
     {"out", "vector export room.obj --eye 0,0,0 --normal 0,0,1 --resolution 16 --texels 1 -o OUT", "vector.json", ""}},
    {"hemitex vector suite -o,--output", {"out", "vector suite -o OUT", "", "", false}},
    {"hemitex vector render -o,--output", {"out", "vector render v -o OUT", "vector.json", ""}},
    {"hemitex vector random -o,--output",
     {"out", "vector random --seed 1 --count 1 --family slivers -o OUT", "slivers-1/vector.json", ""}},
    {"hemitex vector check --junit", {"out", check + "--junit OUT", "", "p.json"}},
    {"hemitex vector check --html", {"out", check + "--html OUT", "", "p.json"}},
    {"hemitex vector check --diff", {"out", check + "--diff OUT", "", "v/vector.json"}},
    {"hemitex vector check --record", {"out", check + named + "--record OUT", "", "p.json"}},
    {"hemitex vector check --minimize", {"out", "vector check v --candidate wrong --minimize OUT", "vector.json", ""}},
    {"hemitex vector run -o,--output", {"out", run + "-o OUT", "front.u32", ""}},
    {"hemitex vector run --junit", {"out", run + "-o answers --junit OUT", "", "p.json"}},
    {"hemitex vector run --html", {"out", run + "-o answers --html OUT", "", "p.json"}},
    {"hemitex vector run --diff", {"out", run + "-o answers --diff OUT", "", "v/vector.json"}},
    {"hemitex vector run --record", {"out", run + "-o answers " + named + "--record OUT", "", "p.json"}},
    {"hemitex vector run --minimize", {"out", wrongRun + "-o answers --minimize OUT", "vector.json", ""}},
    {"hemitex vector calibrate --probes", {"out", "vector calibrate --probes OUT", "", "", false}},
    {"hemitex vector calibrate -o,--output",
     {"out", "vector calibrate probes --candidate drawn -o OUT", "", "probes/edge-rule/vector.json"}},
    {"hemitex vector calibrate --html",
     {"out", "vector calibrate probes --candidate drawn -o answers --html OUT", "", "probes/edge-rule/vector.json"}},
};

std::string replaced(std::string text, const std::string& word, const std::string& by) {
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += by.size())
    text.replace(at, word.size(), by);
  return text;
}

/// The inputs of all commands: scenes, a mesh, a matrix of it, vectors, answers and a profile.
class Inputs : public Shell {
 public:
  Inputs() {
    const Outcome made =
        execute("set -e; h() { " + program +
                "\"$@\" -q >/dev/null; }\n"
                "h vector random --seed 1 --count 1 --family slivers -o random; mv random/slivers-1 v; rm -r random\n"
                "mkdir wrong; tr '\\000-\\377' '\\001-\\377\\000' <v/front.u32 >wrong/front.u32; echo '{}' >p.json\n"
                "h render room.obj --size 8x6 -o map.png; sed s/room.mtl/mapped.mtl/ room.obj >mapped.obj\n"
                "{ cat room.mtl; echo map_Kd map.png; } >mapped.mtl\n"
                "h solve room.obj --facets --resolution 16 --size 8x6 -o f; cp f/scene.vtu box.vtu; rm -r f\n"
                "h formfactors box.vtu " +
                facets +
                "-o F.csv\n"
                "h vector calibrate --probes probes; mkdir drawn\n"
                "for probe in $(ls probes); do h vector render probes/$probe -o drawn/$probe; done");
    INFO(made.err);
    REQUIRE(made.exitCode == 0);
  }
};

/// A writer at work in a folder with inputs.
struct Trial {
  const Inputs& shell;
  const Writer& writer;

  /// The place of the result, and of the file that it writes.
  std::string out() const { return writer.name; }
  std::string file() const { return writer.file.empty() ? out() : out() + '/' + writer.file; }
  std::string command(const std::string& place) const {
    return "timeout -k 5 30 " + program + replaced(writer.command, "OUT", place) + " -q >/dev/null";
  }
  Outcome run() const { return shell.execute(command(out())); }
  void clear() const { shell.execute("rm -rf " + out() + " lit answers G.npz G.json there in-the-way"); }

  /// Makes what is in the way by lines of `sh`, in which FILE is the file that would be written. Requires that the run
  /// ends with a message that contains `words`, and that nothing changes.
  void refuses(const std::string& lines, const std::string& words) const {
    clear();
    shell.execute("mkdir -p $(dirname " + file() + ")\n" + replaced(replaced(lines, "FILE", file()), "OUT", out()));
    const auto before = shell.files();
    const Outcome outcome = run();
    INFO(lines << '\n' << outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains(words));
    CHECK(linesOf(outcome.err).size() == 1);
    CHECK(shell.files() == before);
  }
};

/// Calls `test` with a trial of each writer for which `isTried` is true.
template <typename Test>
void forEachWriter(const Test& test) {
  static const Inputs shell;  // made once for all tests
  for (const auto& [option, writer] : writers) {
    INFO(option);
    const Trial trial{shell, writer};
    trial.clear();
    test(trial);
  }
}

const bool isRoot = geteuid() == 0;

}  // namespace

TEST_CASE("Each option that writes is tried by the tests of outputs", "[outputs]") {
  std::set<std::string> found, tried;
  for (const std::string& line : linesOf(Shell().output("--written-options"))) {
    const std::size_t tab = line.find('\t');
    found.insert(line.substr(0, tab) + ' ' + line.substr(tab + 1, line.rfind('\t') - tab - 1));
  }
  found.erase("hemitex watch --checkpoint");  // is refused
  for (const auto& [option, writer] : writers) tried.insert(option);
  CHECK(found == tried);
}

TEST_CASE("No option replaces a file of another origin, a link, a device or a folder", "[outputs]") {
  forEachWriter([](const Trial& trial) {
    const bool isKnown = !trial.writer.file.empty() || trial.writer.name != "out" || trial.writer.ends;
    trial.refuses("rm -rf OUT; mkdir there; ln -s there OUT", "is a link");
    trial.refuses("rm -rf OUT; echo mine >there; ln -s there OUT", "out");
    trial.refuses("rm -rf OUT; mkfifo OUT", "out");
    if (isRoot) trial.refuses("rm -rf OUT; mknod OUT c 1 3", "out");
    if (!isKnown || !trial.writer.ends) return;
    trial.refuses("echo mine >FILE", "is in the way");
    trial.refuses("mkdir there; ln -s $PWD/there FILE", "is a link");
    trial.refuses("echo mine >there; ln -s $PWD/there FILE", "is a link");
    trial.refuses("ln -s $PWD/nothing FILE", "is a link");
    trial.refuses("mkfifo FILE", "is a device or a pipe");
    trial.refuses("mkdir FILE", "is a folder");
    if (isRoot) trial.refuses("mknod FILE c 1 3", "is a device or a pipe");
  });
}

TEST_CASE("No option replaces an input of its run", "[outputs]") {
  forEachWriter([](const Trial& trial) {
    if (trial.writer.input.empty()) return;
    const auto before = trial.shell.files();
    // A scene in the folder of the result has the name of a file that would be written.
    const bool isInside = trial.writer.input.starts_with("out/");
    const std::string prepared = isInside ? "mkdir out; cp room.obj out/scene.obj; cp room.mtl out/\n" : "";
    const std::string command = isInside ? replaced(trial.command(trial.out()), "room.obj", trial.writer.input)
                                         : trial.command(trial.writer.input);
    const Outcome outcome = trial.shell.execute(prepared + command);
    INFO(command << '\n' << outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains("is read by this run") || Contains("is in the way"));
    trial.clear();
    CHECK(trial.shell.files() == before);
  });
}

TEST_CASE("A folder that cannot be written and a full disk are reported, and nothing stays behind", "[outputs]") {
  if (!isRoot || Shell().execute("unshare -m true").exitCode != 0) {
    WARN("skipped: no file system can be mounted");
    return;
  }
  forEachWriter([](const Trial& trial) {
    const std::string name = trial.writer.name;
    const std::string inside = trial.command("disk/" + name);
    for (const std::string state : {"mount -o remount,ro disk", "head -c 100000 /dev/zero >disk/filler 2>/dev/null"}) {
      // On a full disk a long run ends late, and the program of a device fails.
      if (state.starts_with("head") && (!trial.writer.ends || trial.writer.file == "front.u32")) continue;
      const Outcome outcome = trial.shell.execute(
          "mkdir disk\nunshare -m sh -c \"$(cat <<'END'\nmount -t tmpfs -o size=8k,nr_inodes=4 tmpfs disk\n" + state +
          "\nls -A disk >before\n" + inside +
          "\ncode=$?\nls -A disk | cmp - before || exit 99\nexit $code\nEND\n)\"\ncode=$?\n"
          "rm -r disk before\nexit $code");
      INFO(state << '\n' << outcome.err);
      CHECK(outcome.exitCode == 2);
      CHECK_THAT(outcome.err, Contains("disk"));
    }
  });
}

TEST_CASE("A result replaces the earlier one of the same option, unless it was changed", "[outputs]") {
  forEachWriter([](const Trial& trial) {
    if (!trial.writer.ends) return;
    const Outcome first = trial.run(), second = trial.run();
    INFO(first.err << second.err);
    CHECK(first.exitCode <= 1);
    CHECK(second.exitCode <= 1);
    for (const auto& [name, content] : trial.shell.files()) CHECK(name.find(".hemitex") == std::string::npos);
    if (trial.writer.command.find("--checkpoint") != std::string::npos) return;  // has a hash in itself
    trial.shell.execute("echo mine >>" + trial.file());
    const auto before = trial.shell.files();
    const Outcome third = trial.run();
    CHECK(third.exitCode == 2);
    CHECK_THAT(third.err, Contains(trial.file() + ": was changed since hemitex wrote it"));
    CHECK(trial.shell.files() == before);
  });
}

TEST_CASE("Two runs of one result at once: one writes it, the other is refused or comes after it", "[outputs]") {
  forEachWriter([](const Trial& trial) {
    if (!trial.writer.ends) return;
    const Outcome outcome =
        trial.shell.execute(trial.command(trial.out()) + " & first=$!\n" + trial.command(trial.out()) +
                            "\nsecond=$?\nwait $first\necho $? $second");
    INFO(outcome.err);
    const std::set<std::string> allowed{"0 0\n", "0 2\n", "2 0\n", "1 1\n", "1 2\n", "2 1\n"};
    CHECK(allowed.contains(outcome.out));
    if (outcome.err.find("error") != std::string::npos) CHECK_THAT(outcome.err, Contains("is in use: another run"));
    CHECK_FALSE(readAll(trial.shell.file(trial.file())).empty());
    for (const auto& [name, content] : trial.shell.files()) CHECK(name.find(".hemitex") == std::string::npos);
  });
}

TEST_CASE("A folder from another person cannot lead a run out of it", "[outputs]") {
  const Shell shell;
  shell.execute("mkdir precious; echo thesis >precious/thesis.txt");
  const auto precious = [&] { return shell.execute("cat precious/thesis.txt; ls -A precious").out; };
  for (const std::string planted :
       {"ln -s ../precious out/.hemitex.partial-0", "ln -s ../precious out/lightmaps",
        "ln -s ../precious out/l; echo '{\"files\":{\"l/thesis.txt\":\"0\",\"../precious/thesis.txt\":null}}' "
        ">out/solution.json",
        "ln -s ../precious out/l; echo '{\"files\":{\"l/thesis.txt\":{\"writer\":\"solve\",\"sha256\":[\"\"]}}}' "
        ">out/.hemitex.json",
        "ln -s ../precious/thesis.txt out/.hemitex.json", "ln -s ../precious out/.hemitex.json",
        "ln ../precious/thesis.txt out/scene.obj"}) {
    shell.execute("rm -rf out; mkdir out\n" + planted);
    shell.run(quickSolve + "-o out --lightmap");
    INFO(planted);
    CHECK(precious() == "thesis\nthesis.txt\n");
  }
}

TEST_CASE("A temporary folder of another user is not used", "[outputs]") {
  if (!isRoot) return;
  const Shell shell;
  shell.execute("mkdir -p out/.hemitex.partial-0 .hemitex.partial-abc; chown 65534 out/.hemitex.partial-0 .hemitex.*");
  const Outcome outcome = shell.run(quickSolve + "-o out");
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Contains("out/.hemitex.partial-0: is in the way"));
  shell.output("render room.obj --size 8x6 -o a.png");
  CHECK(shell.files().contains(".hemitex.partial-abc"));
}

TEST_CASE("The record of a folder counts where a file lost its mark", "[outputs]") {
  const Shell shell;
  // A copy has no mark.
  shell.output("render room.obj --size 8x6 -o a.png");
  shell.execute("cp a.png b.png; mv b.png a.png");
  const Outcome unknown = shell.run("render room.obj --size 8x6 -o a.png");
  CHECK(unknown.exitCode == 2);
  CHECK_THAT(unknown.err, Contains("a.png: is in the way"));
  const std::string hash = shell.execute("sha256sum a.png").out.substr(0, 64);
  writeAll(shell.file(".hemitex.json"), R"({"files": {"a.png": {"writer": "render", "sha256": [")" + hash + R"("]}}})");
  shell.output("render room.obj --size 8x6 -o a.png");
}

TEST_CASE("Where a file system keeps no marks, the record of the folder lists results", "[outputs]") {
  const Shell shell;
  if (!isRoot || shell.execute("unshare -m true").exitCode != 0) {
    WARN("skipped: no file system can be mounted");
    return;
  }
  const Outcome outcome = shell.execute(
      "mkdir disk\nunshare -m sh -e -c \"$(cat <<'END'\nmount -t ramfs ramfs disk\ncp room.* disk; cd disk\n" +
      program + "render room.obj --size 8x6 -o a.png -q\n" + program + "render room.obj --size 9x6 -o a.png -q\n" +
      program + quickSolve + "-o out -q\n" + program + quickSolve + "-o out --no-elements -q\n" +
      "ls -A . >&2\nls -A out | grep -e hemitex -e elements && exit 9\necho mine >>a.png\n" + program +
      "render room.obj --size 8x6 -o a.png -q\nEND\n)\"");
  INFO(outcome.err);
  CHECK(outcome.exitCode == 2);
  CHECK_THAT(outcome.err, Contains(".hemitex.json") && Contains("a.png: was changed since hemitex wrote it"));
}
