/// `hemitex solve --gather`: its files and its numbers.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "radiosity/images/image.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::tests;

TEST_CASE("solve --gather writes radiosity and light at the resolution of display textures", "[cli][gather]") {
  const Shell shell;
  const std::string room =
      "solve " HEMITEX_DATA
      "/paper-room.obj --texels 8 --residual 0.05 --resolution 64 --gather --lightmap --magnify 4 --size 40x30 ";
  const auto json = nlohmann::json::parse(shell.output(room + "--json -o lit --threads 2"));
  CHECK(json["gather"]["drawn"] < json["gather"]["texels"]);
  CHECK(json["gather"]["error"] < 0.03);
  const radiosity::Image floor = radiosity::readImage(shell.file("lit/floor.exr")),
                         shown = radiosity::readImage(shell.file("lit/floor.png")),
                         light = radiosity::readImage(shell.file("lit/lightmaps/floor.exr"));
  CHECK(floor.width == shown.width);
  CHECK(light.width == shown.width);
  CHECK(shell.output(room + "-o again --threads 1").find("texels gathered their light") != std::string::npos);
  CHECK(nlohmann::json::parse(shell.files().at("again/solution.json"))["files"] == json["files"]);
}

// Enough texels for seconds, so that the signals arrive during the gather, which the bar of progress tells.
TEST_CASE("A signal ends the gather of a solve and writes filtered textures; a second one ends it at once",
          "[cli][gather]") {
  const Shell shell;
  const auto [signals, code] = GENERATE(table<int, int>({{1, 143}, {2, 143}}));
  const Outcome outcome = shell.execute(
      "python3 -c 'import os, pty, signal, subprocess, sys, time\n"
      "terminal, stderr = pty.openpty()\n"
      "run = subprocess.Popen(sys.argv[2:], stderr=stderr)\nos.close(stderr)\n"
      "seen = b\"\"\n"
      "while b\"gathering\" not in seen: seen += os.read(terminal, 65536)\n"
      "for k in range(int(sys.argv[1])): run.send_signal(signal.SIGTERM); time.sleep(0.02)\n"
      "try:\n while True: seen += os.read(terminal, 65536)\n"
      "except OSError: pass\n"
      "sys.stdout.buffer.write(seen); sys.exit(run.wait())' " +
      std::to_string(signals) +
      " '" HEMITEX_PROGRAM "' --threads 1 solve '" HEMITEX_DATA
      "/cornell-box.obj' --texels 8 --residual 0.3 --resolution 32 --size 40x30 --gather --magnify 16 -o out");
  INFO(outcome.out);
  CHECK(outcome.exitCode == code);
  if (signals == 2) {
    CHECK_FALSE(shell.files().contains("out/solution.json"));
    return;
  }
  CHECK(outcome.out.find("before all texels had gathered their light") != std::string::npos);
  const auto json = nlohmann::json::parse(shell.files().at("out/solution.json"));
  CHECK(json["interrupted"] == true);
  CHECK_FALSE(json.contains("gather"));
  CHECK(json["settings"]["filter"] == "bicubic");
}
