// What the bench's numbers are held to, on numbers made up.
#include "reference/bench/report.h"

#include <catch2/catch.hpp>

using namespace hemitex::reference;

namespace {

/// The machine is half as fast in the last turn, and in the middle one for what runs late in it: ratios turn by turn
/// are those of `seconds`, those of medians are not.
Timing inTurns(double seconds, bool isLate) { return timingOf({seconds, (isLate ? 2 : 1) * seconds, 2 * seconds}); }

BenchRun run(const std::string& scene, std::size_t triangles, int resolution, const std::string& what,
             double milliseconds) {
  const double seconds = milliseconds / 1000;
  return {scene, triangles, 100, resolution, 1, what, inTurns(seconds, what != "hemicube")};
}

const Requirement& requirement(const std::vector<Requirement>& list, const std::string& what) {
  for (const Requirement& of : list)
    if (of.what.find(what) != std::string::npos) return of;
  FAIL("no requirement speaks of " << what);
  return list.front();
}

}  // namespace

TEST_CASE("a requirement is held against the worst run that it speaks of", "[bench]") {
  BenchReport report;
  report.runs = {run("paper-room", 26, 128, "hemicube", 1),      run("paper-room", 26, 128, "embree", 6),
                 run("paper-room", 26, 1024, "hemicube", 10),    run("paper-room", 26, 1024, "embree", 55),
                 run("paper-room", 26, 1024, "floor", 4),        run("paper-room", 8000, 128, "hemicube", 2),
                 run("paper-room", 8000, 128, "embree", 4),      run("gallery", 8088, 128, "hemicube", 2),
                 run("gallery", 8088, 128, "embree", 7),         run("gallery", 8088, 128, "opengl", 20),
                 run("gallery", 8088, 128, "hemicube-mesh", 26), run("gallery", 1000001, 512, "hemicube", 8),
                 run("gallery", 1000001, 512, "embree", 9),      run("gallery", 1000001, 256, "hemicube", 8),
                 run("gallery", 1000001, 256, "embree", 1),      run("gallery", 1000001, 256, "opengl", 60)};
  const std::vector<Requirement> list = requirementsOf(report);
  const auto check = [&list](const std::string& what, double measured, bool isKept) {
    const Requirement& found = requirement(list, what);
    CHECK(found.measured == Approx(measured));
    CHECK(found.isKept == isKept);
  };
  check("Embree, the room", 5.5, true);  // as it is, not cut
  check("Embree, the complex scene", 3.5, false);
  check("Embree, 1,000,000 triangles", 9.0 / 8, true);  // not below R = 512
  check("OpenGL, from 8,000", 7.5, false);
  check("the floor", 2.5, true);
  check("meshing", 13, false);
  CHECK(list.size() == 6);  // nothing was drawn by OpenGL from fewer triangles
}

TEST_CASE("what was not run is held against nothing", "[bench]") { CHECK(requirementsOf({}).empty()); }

TEST_CASE("the further requirements compare what they say", "[bench]") {
  BenchReport report;
  report.cores = CoreGains{2, 1.9, 1.8, 0.931, 0.929};
  report.walls = {{32, inTurns(3, true), inTurns(2, false)}};
  report.growth = {
      {"paper-room",
       512,
       {{16, 1, inTurns(1, false), {}}, {64, 1, inTurns(9, false), {}}, {1024, 1, inTurns(1.06, true), {}}}}};
  report.parts = {{.elements = 9, .hemicubes = 12, .spreading = 4, .besideOfTotal = 0.2}};
  report.memory = SolutionMemory{64, 25, 0};
  report.errors = {{"cornell-box", 256, 1, 0.1, 0.25}};
  const std::vector<Requirement> list = requirementsOf(report);
  CHECK(list.size() == 8);
  CHECK(requirement(list, "second core, a hemicube").isKept);
  CHECK_FALSE(requirement(list, "second core, a solution").isKept);
  CHECK(requirement(list, "moved wall").measured == Approx(1.5));
  CHECK(requirement(list, "drawing time").measured == Approx(1.06));
  CHECK_FALSE(requirement(list, "drawing time").isKept);
  CHECK(requirement(list, "beside its hemicubes").measured == Approx(0.2));
  CHECK(requirement(list, "bytes an element").isKept);
  CHECK_FALSE(requirement(list, "bytes a pixel").isKept);
  CHECK(requirement(list, "cornell-box at R = 256").measured == Approx(0.4));
}

TEST_CASE("between two numbers of triangles Embree becomes faster where the line through both says so", "[bench]") {
  // Two times slower at 100, two times faster at 10,000: equal at 1000.
  std::vector<BenchRun> runs{run("a", 100, 64, "hemicube", 1),   run("a", 100, 64, "embree", 2),
                             run("a", 10000, 64, "hemicube", 2), run("a", 10000, 64, "embree", 1),
                             run("b", 100, 64, "hemicube", 1),   run("b", 100, 64, "embree", 0.5),
                             run("c", 100, 64, "hemicube", 1),   run("c", 100, 64, "embree", 2)};
  const std::vector<Crossover> found = crossovers(runs);
  REQUIRE(found.size() == 3);
  CHECK(found[0].triangles.value() == Approx(1000));
  CHECK(found[1].triangles.value() == 100);  // always faster
  CHECK_FALSE(found[2].triangles);           // never
}
