/// `hemitex solve --gather`: its files and its numbers.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"
#include "tests/support/shell.h"

using namespace hemitex;
using namespace hemitex::tests;

TEST_CASE("solve --gather writes radiosity and light at the resolution of display textures", "[cli][gather]") {
  const Shell shell;
  const std::string room =
      "solve " HEMITEX_DATA
      "/paper-room.obj --texels 4 --residual 0.1 --resolution 32 --gather --lightmap --magnify 4 --size 40x30 ";
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

TEST_CASE("render --gather shows the light of a folder and of its scene, which the folder of maps does not hold",
          "[cli][gather]") {
  const Shell shell;
  writeAll(shell.file("two.obj"),
           "mtllib two.mtl\nv 0 0 0\nv 0 0 1\nv 1 0 1\nv 1 0 0\nv .4 .5 .4\nv .6 .5 .4\nv .6 .5 .6\nv .4 .5 .6\n"
           "v 0 1 0\nv 1 1 0\ng floor\nusemtl grey\nf 1 2 3 4\ng lamp\nusemtl lamp\nf 5 6 7 8\n"
           "g wall\nusemtl grey\nf 1 4 10 9\n");
  writeAll(shell.file("two.mtl"), "newmtl grey\nKd .5 .6 .7\nnewmtl lamp\nKd 0 0 0\nKe 9 8 7\n");
  const std::string solve = "solve two.obj --texels 8 --resolution 64 --magnify 2 --size 40x30 ",
                    size = " --gather --size 40x30 ";
  shell.output(solve + "-o lit");
  const std::string exposure =
      " --exposure " + nlohmann::json::parse(shell.files().at("lit/solution.json"))["settings"]["exposure"].dump();
  shell.output("render lit" + size + "-o a.png");
  shell.output("render two.obj --texels 8 --resolution 64" + size + exposure + " -o b.png");
  shell.output(solve + "--gather -o gathered");
  shell.output("render gathered/scene.obj --show elements --size 40x30 -o c.png");
  const auto mean = [&](const std::string& one, const std::string& other) {
    const radiosity::Image a = radiosity::readImage(shell.file(one)), b = radiosity::readImage(shell.file(other));
    double sum = 0, difference = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      sum += radiosity::bandSum(a.pixels[i]);
      difference += radiosity::bandSum(glm::abs(a.pixels[i] - b.pixels[i]));
    }
    return difference / sum;
  };
  CHECK(mean("a.png", "b.png") < 0.01);
  CHECK(mean("a.png", "c.png") < 0.1);  // elements of 1/8

  writeAll(shell.file("out.obj"), "mtllib out.mtl\nusemtl m\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  writeAll(shell.file("out.mtl"), "newmtl m\nKe 1 1 1\nmap_Ke map.png\n");
  radiosity::writePng(shell.file("map.png"), {2, 1, {glm::dvec3(0.5), glm::dvec3(1)}});
  shell.output("solve out.obj --texels 2 --size 40x30 -o mapped");
  const Outcome refused = shell.run("render mapped" + size + "-o e.png");
  CHECK(refused.exitCode == 2);
  CHECK(refused.err.find("does not hold the maps of materials that its light needs") != std::string::npos);
  CHECK_FALSE(shell.files().contains("e.png"));
}
