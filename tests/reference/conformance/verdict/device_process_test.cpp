#include "reference/conformance/verdict/device_process.h"

#include <catch2/catch.hpp>
#include <csignal>

#include "raster/base/input_error.h"

using namespace hemitex;
using reference::DeviceFault;
using Words = std::vector<std::string>;

TEST_CASE("splitCommand splits at blanks outside quotes", "[verdict]") {
  CHECK(reference::splitCommand("  my-device  {vector}\t--out={output} ") ==
        Words{"my-device", "{vector}", "--out={output}"});
  CHECK(reference::splitCommand(R"('my device' -a"b  c"'d"e' "" '')") == Words{"my device", "-ab  cd\"e", "", ""});
  for (const char* command : {"", "  ", "'my device", "device \"{vector}", "'' x"}) {
    INFO(command);
    CHECK_THROWS_AS(reference::splitCommand(command), raster::InputError);
  }
}

TEST_CASE("fillCommand replaces marks inside words, and nothing in what it inserts", "[verdict]") {
  CHECK(reference::fillCommand({"{vector}", "-o={output}:{vector}", "{other}", ""}, "a {output}", "b") ==
        Words{"a {output}", "-o=b:a {output}", "{other}", ""});
}

TEST_CASE("failureOf names exit code, signal and time limit", "[verdict]") {
  CHECK(reference::failureOf({.exitCode = 3}).fault == DeviceFault::ExitCode);
  CHECK(reference::failureOf({.exitCode = 3}).message == "ended with exit code 3");
  CHECK(reference::failureOf({.signal = SIGSEGV}).fault == DeviceFault::Crash);
  CHECK(reference::failureOf({.signal = SIGSEGV}).message.find("ended by signal 11 (") == 0);
  CHECK(reference::failureOf({.signal = SIGKILL, .isTimedOut = true}).fault == DeviceFault::TimeLimit);
}
