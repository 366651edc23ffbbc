// Programs that succeed, fail, crash, hang and talk.
#include "reference/base/child_process.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <memory>
#include <thread>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using raster::InputError;
using reference::ChildProcess;
using reference::ProcessResult;
using Words = std::vector<std::string>;

namespace {

struct Script {
  explicit Script(const std::string& text) { std::ofstream(folder.path / "device.sh") << text << '\n'; }

  ProcessResult run(double seconds = 60, const std::atomic<bool>* isCancelled = nullptr) const {
    return reference::runProcess({"/bin/sh", (folder.path / "device.sh").string(), folder.path.string()}, seconds,
                                 isCancelled);
  }

  /// The program, which reads and writes lines.
  std::unique_ptr<ChildProcess> start() const {
    return std::make_unique<ChildProcess>(Words{"/bin/sh", (folder.path / "device.sh").string()},
                                          ChildProcess::Talk::Lines);
  }

  TemporaryFolder folder;
};

bool isAnswer(const std::string& line) { return line.starts_with("answer"); }

double secondsOf(const std::function<void()>& action) {
  const auto begin = std::chrono::steady_clock::now();
  action();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

TEST_CASE("runProcess returns exit code and signal", "[process]") {
  const ProcessResult success = Script("echo ignored; cat; exit 0").run();
  CHECK(success.hasSucceeded());
  CHECK(success.lastLines.empty());
  const ProcessResult exit = Script("exit 3").run();
  CHECK(exit.exitCode == 3);
  const ProcessResult crash = Script("kill -SEGV $$").run();
  CHECK(crash.signal == SIGSEGV);
  CHECK_FALSE(crash.isTimedOut);
  CHECK_THROWS_AS(reference::runProcess({"/no/such/program"}, 1), InputError);
  CHECK_THROWS_AS(reference::runProcess({"/"}, 1), InputError);
}

TEST_CASE("runProcess keeps the last lines of stderr", "[process]") {
  const ProcessResult result =
      Script("i=0; while [ $i -lt 5000 ]; do echo line $i >&2; i=$((i+1)); done; printf end >&2; exit 1").run();
  REQUIRE(result.lastLines.size() == 10);
  CHECK(result.lastLines[0] == "line 4991");
  CHECK(result.lastLines[9] == "end");
}

TEST_CASE("runProcess stops the process group at the time limit", "[process]") {
  ProcessResult result;
  CHECK(secondsOf([&] { result = Script("echo started >&2; sleep 60 & sleep 60").run(0.3); }) < 20);
  CHECK(result.isTimedOut);
  CHECK(result.lastLines == Words{"started"});
  // A program that ignores SIGTERM.
  CHECK(secondsOf([&] { result = Script("trap '' TERM; while :; do sleep 0.1; done").run(0.2); }) < 20);
  CHECK(result.isTimedOut);
  CHECK(result.signal == SIGKILL);
}

TEST_CASE("runProcess waits for the program only, and stops what it left behind", "[process]") {
  const Script script("(sleep 60; echo late >$1/late) & echo $! >$1/child; exit 0");
  ProcessResult result;
  CHECK(secondsOf([&] { result = script.run(); }) < 20);
  CHECK(result.hasSucceeded());
  const int child = std::stoi(raster::readFile(script.folder.path / "child"));
  // The child ends soon after SIGKILL.
  for (int k = 0; k < 500 && kill(child, 0) == 0; ++k) {
    const std::string state = raster::tryReadFile("/proc/" + std::to_string(child) + "/stat").value_or("0 (sh) Z");
    if (state.find(") Z") != std::string::npos) return;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK(kill(child, 0) != 0);
}

TEST_CASE("runProcess ends when it is cancelled", "[process]") {
  std::atomic<bool> isCancelled{false};
  std::thread cancel([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    isCancelled = true;
  });
  CHECK(secondsOf([&] { Script("sleep 60").run(60, &isCancelled); }) < 20);
  cancel.join();
}

TEST_CASE("ChildProcess::ask returns the answer to each request of one program, and no other line", "[process]") {
  const Script script(
      "n=0; while read -r line; do n=$((n+1)); echo log; echo $n >&2; echo answer $n \"$line\"; done; exit 4");
  const auto process = script.start();
  for (int k = 1; k <= 300; ++k)
    REQUIRE(process->ask("a  b" + std::to_string(k), isAnswer, 60) ==
            "answer " + std::to_string(k) + " a  b" + std::to_string(k));
  CHECK(process->lastLines() == Words{"300"});
  // A request and an answer that are longer than what a pipe holds.
  const std::string text(200000, 'x');
  REQUIRE(process->ask(
      text, [](const std::string& line) { return line.size() < 5000 && line.ends_with("xxx"); }, 60));
  const ProcessResult end = process->finish(60);
  CHECK(end.exitCode == 4);
  CHECK_FALSE(end.isTimedOut);
}

TEST_CASE("ChildProcess::ask gives up when the program ends, is silent or is cancelled, and finish says why",
          "[process]") {
  const Script exits("read line; echo bye >&2; exit 3");
  const auto exiting = exits.start();
  CHECK_FALSE(exiting->ask("a", isAnswer, 60));
  const ProcessResult exit = exiting->finish(0);
  CHECK(exit.exitCode == 3);
  CHECK(exit.lastLines == Words{"bye"});

  const Script crashes("echo answer; kill -SEGV $$");
  const auto crashing = crashes.start();
  CHECK(crashing->ask("a", isAnswer, 60) == "answer");
  for (int k = 0; k < 3; ++k) CHECK_FALSE(crashing->ask("b", isAnswer, 60));  // writing to it ends no program of ours
  CHECK(crashing->finish(0).signal == SIGSEGV);

  const Script sleeps("exec sleep 60");
  const auto late = sleeps.start(), cancelled = sleeps.start();
  CHECK_FALSE(late->ask("a", isAnswer, 0.1));
  CHECK(late->finish(0).isTimedOut);
  const std::atomic<bool> isCancelled{true};
  CHECK(secondsOf([&] { CHECK_FALSE(cancelled->ask("a", isAnswer, 60, &isCancelled)); }) < 20);
  CHECK_THROWS_AS(ChildProcess(Words{"/no/such/program"}, ChildProcess::Talk::Lines), InputError);
}

TEST_CASE("ChildProcess ends its program, also one that reads nothing", "[process]") {
  const Script reads("while read line; do echo answer; done; echo end >$(dirname $0)/end"), sleeps("exec sleep 60");
  const auto ask = [](const Script& script, double seconds) { script.start()->ask("a", isAnswer, seconds); };
  ask(reads, 60);
  CHECK(raster::readFile(reads.folder.path / "end") == "end\n");
  CHECK(secondsOf([&] { ask(sleeps, 0.1); }) < 20);
}

TEST_CASE("startDetached fails where the program cannot be started or ends with an exit code other than 0",
          "[process]") {
  const std::chrono::seconds wait(10);
  CHECK(reference::startDetached({"/bin/true"}, wait));
  CHECK_FALSE(reference::startDetached({"/bin/false"}, wait));
  CHECK_FALSE(reference::startDetached({"/no/such/program"}, wait));
  CHECK(reference::startDetached({"/bin/sleep", "1"}, std::chrono::milliseconds(50)));
}
