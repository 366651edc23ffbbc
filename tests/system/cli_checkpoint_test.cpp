/// Long runs of `hemitex solve`: checkpoints, signals, and folders that are whole.
#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "tests/support/shell.h"

using namespace hemitex::tests;
using Catch::Matchers::Contains;
using nlohmann::json;

namespace {

/// A solution of about a second, by plain shots, by growing effort or with smaller elements.
const std::string plain = "solve room.obj --texels 16 --patch 2 --resolution 128 --residual 1e-4 --size 40x30 ";
const std::string bounded = "solve room.obj --texels 8 --patch 4 --max-error 0.002 --size 40x30 ";
const std::string adaptive =
    "solve room.obj --texels 32 --adaptive 0.0002 --resolution 64 --residual 1e-4 --size 40x30 ";

/// Removes the times from a solution.json and from its frames.
void removeTimes(json& value) {
  if (value.is_object()) value.erase("times");
  if (value.is_structured())
    for (json& part : value) removeTimes(part);
}

/// The files of a result without times.
std::map<std::string, std::string> resultIn(const Shell& shell, const std::string& folder) {
  std::map<std::string, std::string> result;
  for (const auto& [name, content] : shell.files())
    if (name.starts_with(folder + "/")) result[name.substr(folder.size() + 1)] = content;
  for (auto& [name, content] : result)
    if (name.ends_with("solution.json")) {
      json solution = json::parse(content);
      removeTimes(solution);
      content = solution.dump();
    }
  return result;
}

}  // namespace

TEST_CASE("A solve that is killed again and again ends with the bytes of one that ran through", "[checkpoint]") {
  const auto command = GENERATE(as<std::string>{}, plain, bounded, adaptive);
  INFO(command);
  const Shell shell;
  shell.output(command + "-o whole");
  const std::string checked = command + "-o pieces --checkpoint c --every 0.01 ";
  shell.execute(program + checked +
                "& run=$!\nwhile [ ! -e c ] && kill -0 $run; do sleep 0.02; done\nkill -KILL $run\nwait $run");
  // The last of the runs ends by itself.
  const Outcome last = shell.execute("for pause in 0.15 0.2 0.25; do\n" + program + checked +
                                     "--resume c -q & run=$!\nsleep $pause\nkill -KILL $run\nwait $run\ndone\n" +
                                     program + checked + "--resume c");
  INFO(last.err);
  REQUIRE(last.exitCode == 0);
  CHECK(resultIn(shell, "pieces") == resultIn(shell, "whole"));
}

TEST_CASE("A solve with edits that is stopped in any frame goes on there, to the bytes of one that ran through",
          "[checkpoint]") {
  const Shell shell;
  writeAll(shell.file("box.obj"), "v 0 -1 0\nv 0.5 -1 0\nv 0.5 0 0\nv 0 0 0\ng sheet\nf 1 2 3 4\n");
  writeAll(shell.file("edits.json"), R"({"frames": [
    [{"add": "box.obj"}, {"reflectance": "floor", "to": [0.2, 0.2, 0.2]}],
    [{"move": "sheet", "by": [0.25, 0, 0.25]}, {"emission": "ceiling/lamp", "to": [0, 5, 5]}],
    [{"remove": "sheet"}]]})");
  const std::string edited = plain + "--edits edits.json ";
  shell.output(edited + "-o whole");
  const std::map<std::string, std::string> whole = resultIn(shell, "whole");
  // Each signal comes later in the run, so that it stops another frame.
  bool isStopped = true;
  std::set<std::size_t> lengths;
  for (int pause = 1; isStopped; ++pause) {
    const std::string resume = pause == 1 ? "" : "--resume c ";
    const Outcome outcome = shell.execute("timeout -s INT " + std::to_string(0.3 * std::pow(1.2, pause)) + " " +
                                          program + edited + "-o pieces --checkpoint c --every 1000 -q " + resume);
    INFO(outcome.err);
    REQUIRE(pause < 40);
    isStopped = outcome.exitCode != 0;
    const std::string kept = readAll(shell.file("c"));
    REQUIRE(kept.size() > 0);
    lengths.insert(kept.size() / (std::size_t{1} << 12));
  }
  CHECK(lengths.size() >= 2);  // snapshots of several frames
  CHECK(resultIn(shell, "pieces") == whole);

  writeAll(shell.file("edits.json"), R"({"frames": [[{"emission": "ceiling/lamp", "to": [5, 5, 5]}]]})");
  CHECK_THAT(shell.run(edited + "-o other --resume c").err, Contains("belongs to other settings"));
}

TEST_CASE("A signal ends a solve after its shot, with its result and the way to go on", "[checkpoint]") {
  const auto [name, code] = GENERATE(table<std::string, int>({{"INT", 130}, {"TERM", 143}}));
  const Shell shell;
  // The shell ignores SIGINT in background commands, so that a subshell restores it.
  const std::string endless =
      "solve room.obj --texels 16 --patch 1 --resolution 64 --residual 1e-300 --size 40x30 -o out ";
  const Outcome outcome = shell.execute(
      "python3 -c 'import os, signal, subprocess, sys, time\n"
      "signal.signal(signal.SIGINT, signal.SIG_DFL)\n"
      "run = subprocess.Popen(sys.argv[2:])\ntime.sleep(0.7)\n"
      "run.send_signal(getattr(signal, \"SIG\" + sys.argv[1]))\nsys.exit(run.wait())' " +
      name + " " + program + endless + "--checkpoint c");
  CHECK(outcome.exitCode == code);
  CHECK_THAT(outcome.err, Contains("a signal stopped the run after") && Contains("--resume 'c' goes on"));
  const json solution = json::parse(shell.files().at("out/solution.json"));
  CHECK(solution["interrupted"] == true);
  CHECK(solution["shots"] > 0);
  shell.output("render out/scene.obj -o picture.png --size 40x30");
}

TEST_CASE("A signal before the first shot ends a solve at once, with one line and no result", "[checkpoint]") {
  const Shell shell;
  const auto before = shell.files();
  // The light of the sky is drawn before the first shot, and takes minutes on one thread.
  const Outcome outcome =
      shell.execute("timeout --preserve-status -s TERM 2 " + program +
                    "--threads 1 solve room.obj --texels 64 --resolution 4096 --sky 1,1,1 --size 40x30 -o out");
  CHECK(outcome.exitCode == 143);
  CHECK(outcome.err == "hemitex: a signal ended the run at once, without a result\n");
  CHECK(shell.files() == before);
}

TEST_CASE("A checkpoint that does not fit is refused with the reason", "[checkpoint]") {
  const Shell shell;
  const std::string small = "solve room.obj --texels 4 --patch 2 --resolution 32 --size 40x30 -o out ";
  shell.output(small + "--checkpoint c");
  shell.output(small + "--resume c");
  const auto refused = [&](const std::string& arguments, const std::string& reason) {
    const Outcome outcome = shell.run(arguments);
    INFO(arguments << '\n' << outcome.err);
    CHECK(outcome.exitCode == 2);
    CHECK_THAT(outcome.err, Contains(reason));
  };
  refused(small + "--resume c --split 0.5", "c: belongs to other settings");
  refused(small + "--resume c --emit floor=1,1,1", "c: belongs to another scene");
  // With --max-error the effort follows what the camera sees.
  const std::string bounded = "solve room.obj --texels 2 --size 40x30 --max-error 0.4 -o out ";
  shell.output(bounded + "--checkpoint seen");
  shell.output(bounded + "--resume seen");
  refused(bounded + "--fov 10 --resume seen", "seen: belongs to other settings");
  refused(small + "--resume room.obj", "room.obj: is not a checkpoint");
  refused(small + "--resume none", "none: cannot be read");
  refused(small + "--checkpoint room.obj/c", "room.obj is a file");
  std::string bytes = readAll(shell.file("c"));
  bytes[bytes.size() / 2] ^= 1;
  writeAll(shell.file("c"), bytes);
  refused(small + "--resume c", "c: is damaged");
}

TEST_CASE("One run at a time writes a checkpoint; another one is refused and disturbs nothing", "[checkpoint]") {
  const Shell shell;
  const std::string endless =
      "solve room.obj --texels 16 --patch 1 --resolution 64 --residual 1e-300 --size 40x30 --checkpoint c --every "
      "0.01 ";
  const Outcome others =
      shell.execute(program + endless + "-q -o first & run=$!\nuntil [ -e c ]; do sleep 0.01; done\n" + program +
                    endless + "-o second; second=$?\n" + program + endless + "-o third; third=$?\n" +
                    "kill -0 $run || exit 99\nkill -KILL $run\nwait $run\n[ $second = 2 ] && [ $third = 2 ]");
  INFO(others.err);
  CHECK(others.exitCode == 0);
  CHECK(others.err.find("c: is in use: another run writes its result there") != others.err.rfind("c: is in use"));
  CHECK_FALSE(shell.files().contains("second"));
  shell.output("solve room.obj --texels 4 --resolution 32 --shots 2 --size 40x30 --checkpoint c -o second");
}

TEST_CASE("--progress json prints lines of JSON, and the last one is that of the last shot", "[checkpoint]") {
  const Shell shell;
  const Outcome outcome = shell.run(plain + "-o out -q --progress json");
  REQUIRE(outcome.exitCode == 0);
  const std::vector<std::string> lines = linesOf(outcome.err);
  REQUIRE_FALSE(lines.empty());
  int shots = 0;
  for (const std::string& line : lines) {
    const json progress = json::parse(line);
    CHECK(progress["shots"] > shots);
    CHECK(progress["shots_per_s"] > 0);
    CHECK((progress["left_s"].is_null() || progress["left_s"] >= 0));
    shots = progress["shots"];
  }
  const json solution = json::parse(shell.files().at("out/solution.json"));
  CHECK(solution["shots"] == shots);
  CHECK(json::parse(lines.back())["residual"] == solution["residual"]);
  CHECK(json::parse(lines.back())["left_s"] == 0);  // the residual is below its limit
}

TEST_CASE("Without a terminal -v shows a line of progress at the start and every ten seconds", "[checkpoint]") {
  const Shell shell;
  // Stops the run at its second line. A line is read a little after it is printed, so that the gap may look shorter.
  const Outcome outcome = shell.execute(
      "timeout 120 python3 -c 'import subprocess, sys, time\n"
      "run = subprocess.Popen(sys.argv[1:], stderr=subprocess.PIPE, text=True)\n"
      "times = [time.monotonic() for line, _ in zip((l for l in run.stderr if \"shots/s\" in l), range(2))]\n"
      "run.terminate()\nprint(times[1] - times[0] > 9.5, times[1] - times[0] < 60)' " +
      program + "solve room.obj --texels 64 --patch 1 --resolution 512 --residual 1e-300 --size 40x30 -o out -v");
  CHECK(outcome.out.ends_with("True True\n"));
}

TEST_CASE("solution.json names every file with its hash, and a mixture is refused", "[checkpoint]") {
  const Shell shell;
  shell.output(quickSolve + "-o out");
  const json files = json::parse(shell.files().at("out/solution.json"))["files"];
  std::set<std::string> present, named = {"solution.json"};
  for (const auto& [name, content] : shell.files())
    if (name.starts_with("out/")) present.insert(name.substr(4));
  for (const auto& [name, hash] : files.items()) named.insert(name);
  CHECK(named == present);
  shell.output("render out/scene.obj -o picture.png --size 40x30");
  const Outcome sum = shell.execute("cd out && sha256sum floor.exr");
  CHECK(sum.out.substr(0, 64) == files["floor.exr"].get<std::string>());

  writeAll(shell.file("out/floor.exr"), readAll(shell.file("out/left.exr")));
  const Outcome mixed = shell.run("render out/scene.obj -o picture.png --size 40x30");
  CHECK(mixed.exitCode == 2);
  CHECK_THAT(mixed.err, Contains("floor.exr: is not the file that solution.json beside it names"));
}

TEST_CASE("A new result replaces the files of the old one and no others", "[checkpoint]") {
  const Shell shell;
  shell.output(quickSolve + "-o out --report");
  writeAll(shell.file("out/my.png"), "mine");
  shell.execute("sed -i s/left/links/ room.obj");
  shell.output(quickSolve + "-o out");
  const auto files = shell.files();
  CHECK(files.contains("out/links.png"));
  CHECK_FALSE(files.contains("out/left.png"));
  CHECK_FALSE(files.contains("out/report.html"));
  CHECK(files.at("out/my.png") == "mine");
}
