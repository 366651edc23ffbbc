/// How the hemitex program writes a result: whole or not at all, one run at a time, and what signals leave behind.
#include <catch2/catch.hpp>
#include <string>

#include "tests/support/shell.h"

using namespace hemitex::tests;

namespace {

/// Starts a solution of hours in the background and waits until it has its temporary folder.
const std::string startLongRun =
    program +
    "solve room.obj -o out --texels 64 --patch 1 --resolution 1024 --residual 1e-300 & run=$!\n"
    "until [ -d out/.hemitex.partial-0 ]; do sleep 0.01; done\n";

}  // namespace

TEST_CASE("A second run into a folder in use is refused, and the first goes on", "[results]") {
  const Shell shell;
  const Outcome second = shell.execute(startLongRun + program + quickSolve +
                                       "-o out; code=$?\n"
                                       "kill -0 $run || exit 99\nkill -KILL $run\nexit $code");
  CHECK(second.exitCode == 2);
  CHECK(second.err.find("out: is in use: another run writes its result there") != std::string::npos);
}

TEST_CASE("A run takes the place of one that was killed, and removes its temporary files", "[results]") {
  const Shell shell;
  CHECK(shell
            .execute(startLongRun + "kill -KILL $run\nwait $run\ntouch out/.hemitex.partial-0/stale.exr\n"
                                    "mkdir out/.hemitex.partial-1 out/.hemitex.partial-2")
            .exitCode == 0);
  shell.output(quickSolve + "-o out");
  const auto files = shell.files();
  CHECK(files.contains("out/solution.json"));
  for (const std::string number : {"0", "1", "2"}) CHECK_FALSE(files.contains("out/.hemitex.partial-" + number));
  CHECK_FALSE(files.contains("out/stale.exr"));
}

TEST_CASE("Two pictures are written into one folder at the same time", "[results]") {
  const Shell shell;
  const Outcome both = shell.execute("for name in a b c d e f; do " + program +
                                     "render room.obj -o $name.png --size 40x30 & runs=\"$runs $!\"; done\nfor run in "
                                     "$runs; do wait $run || exit 1; done");
  CHECK(both.exitCode == 0);
  for (const std::string name : {"a.png", "f.png"}) CHECK(shell.files().at(name) == shell.files().at("b.png"));
}

TEST_CASE("A folder's name may have 255 characters", "[results]") {
  const Shell shell;
  const std::string name(255, 'n');
  shell.output(quickSolve + "-o " + name);
  CHECK(shell.files().contains(name + "/solution.json"));
}

TEST_CASE("SIGTERM ends a measurement at once and leaves nothing behind", "[results]") {
  const Shell shell;
  const auto before = shell.files();
  // Without a pause the signal arrives while the folders are made.
  const std::string pause = GENERATE("sleep 0.1", ":", ":", ":");
  const std::string part = GENERATE("", "/.hemitex.partial-0");
  const Outcome outcome = shell.execute(program +
                                        "tradeoff room.obj -o out & run=$!\n"
                                        "until [ -d out" +
                                        part + " ]; do " + pause +
                                        "; done\n"
                                        "kill -TERM $run\nwait $run");
  CHECK(outcome.exitCode == 143);
  CHECK(shell.files() == before);
}

TEST_CASE("Pipes and devices are refused as input before anything is read", "[results]") {
  const Shell shell;
  shell.execute("mkfifo pipe; ln -s /dev/zero zero");
  const auto arguments = GENERATE(as<std::string>{}, "solve pipe -o out", "solve zero -o out", "solve /dev/zero -o out",
                                  "solve room.obj -o out --edits pipe", "solve room.obj -o out --lights zero");
  const Outcome outcome = shell.execute("timeout 20 " + program + arguments);
  CHECK(outcome.exitCode == 2);
  CHECK(outcome.err.find("is a pipe or a device, not a file") != std::string::npos);
}
