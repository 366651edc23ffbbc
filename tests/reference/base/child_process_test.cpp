// Programs that succeed, fail, crash, hang and talk.
#include "reference/base/child_process.h"

#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fstream>
#include <thread>

#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using raster::InputError;
using reference::ProcessResult;
using Words = std::vector<std::string>;

namespace {

struct Script {
  explicit Script(const std::string& text) { std::ofstream(folder.path / "device.sh") << text << '\n'; }

  ProcessResult run(double seconds = 60, const std::atomic<bool>* isCancelled = nullptr) const {
    return reference::runProcess({"/bin/sh", (folder.path / "device.sh").string(), folder.path.string()}, seconds,
                                 isCancelled);
  }

  TemporaryFolder folder;
};

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

TEST_CASE("startDetached fails where the program cannot be started or ends with an exit code other than 0",
          "[process]") {
  const std::chrono::seconds wait(10);
  CHECK(reference::startDetached({"/bin/true"}, wait));
  CHECK_FALSE(reference::startDetached({"/bin/false"}, wait));
  CHECK_FALSE(reference::startDetached({"/no/such/program"}, wait));
  CHECK(reference::startDetached({"/bin/sleep", "1"}, std::chrono::milliseconds(50)));
}
