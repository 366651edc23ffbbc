/// hemitex matrix: judges and compares the matrices that formfactors writes.
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/shell.h"

using namespace hemitex::tests;
using nlohmann::json;

TEST_CASE("hemitex matrix check accepts a matrix of formfactors, and names the fault of a spoiled one", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --max-error 0.01 -o F.csv");
  CHECK(shell.output("matrix check F.csv room.obj").find("nothing wrong was found") != std::string::npos);

  // All walls of the cube have one area, so that the true matrix is symmetric; percent are not.
  shell.execute("awk -F, -v OFS=, 'NR > 1 && $2 ~ /^[0-9]+$/ {$3 = 100 * $3} {print}' F.csv > percent.csv");
  const Outcome outcome = shell.run("matrix check percent.csv room.obj");
  CHECK(outcome.exitCode == 1);
  CHECK(outcome.out.find("fault: entries are in percent") != std::string::npos);
  const json verdict = json::parse(shell.run("matrix check percent.csv room.obj --json").out);
  CHECK(verdict["fault"] == "entries are in percent");
  CHECK(verdict["problems"].size() >= 2);
}

TEST_CASE("hemitex matrix check and compare refuse what is no matrix of the mesh", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --max-error 0.02 -o F.npz");
  for (const char* arguments : {"check room.mtl room.obj", "check missing.npz room.obj", "check F.npz missing.obj",
                                "compare F.npz missing.npz room.obj"}) {
    CAPTURE(arguments);
    const Outcome outcome = shell.run("matrix " + std::string(arguments));
    CHECK(outcome.exitCode == 2);
    CHECK_FALSE(outcome.err.empty());
  }
}

TEST_CASE("hemitex matrix compare of a matrix with itself is 0, and of two methods small", "[cli]") {
  const Shell shell;
  shell.output("formfactors room.obj --all --facets --max-error 0.01 -o a.npz");
  shell.output("formfactors room.obj --all --facets --method rays -o b.npz");
  CHECK(json::parse(shell.output("matrix compare a.npz a.npz room.obj --json"))["difference"] == 0);
  const json difference = json::parse(shell.output("matrix compare a.npz b.npz room.obj --json"));
  CHECK(difference["difference"] > 0);
  CHECK(difference["difference"] < 0.01);
  CHECK(difference["facets"].size() == 6);
}
