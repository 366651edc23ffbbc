// Ratios and crossovers of given times.
#include "reference/measurement/bench/report.h"

#include <catch2/catch.hpp>

using namespace hemitex::reference;

namespace {

/// Times of a machine that is half as fast in the last repetition and in the second half of the one before. The median
/// of the ratios is that of `seconds`; the ratio of medians is not.
Timing disturbed(double seconds, bool isLate) { return timingOf({seconds, (isLate ? 2 : 1) * seconds, 2 * seconds}); }

BenchRun run(const std::string& scene, std::size_t triangles, int resolution, const std::string& what,
             double milliseconds) {
  const double seconds = milliseconds / 1000;
  return {scene, triangles, 100, resolution, 1, what, disturbed(seconds, what != "hemicube")};
}

}  // namespace

TEST_CASE("benchRatios compares with the hemicube of the same scene, triangles and resolution", "[bench]") {
  const std::vector<BenchRatio> ratios = benchRatios(
      {run("room", 26, 128, "hemicube", 1), run("room", 26, 128, "embree", 6), run("room", 26, 512, "hemicube", 10),
       run("room", 26, 512, "embree", 55), run("room", 8000, 128, "hemicube", 2), run("room", 8000, 128, "floor", 0.5),
       run("room", 26, 128, "solution", 9), run("gallery", 26, 128, "embree", 6)});
  REQUIRE(ratios.size() == 3);  // solutions choose other patches, and the gallery has no hemicube
  CHECK(ratios[0].overHemicube == Approx(6));
  CHECK(ratios[1].resolution == 512);
  CHECK(ratios[1].overHemicube == Approx(5.5));
  CHECK(ratios[2].triangles == 8000);
  CHECK(ratios[2].what == "floor");
  CHECK(ratios[2].overHemicube == Approx(0.25));
}

TEST_CASE("benchRatios has the faster of both OpenGL paths only", "[bench]") {
  const std::vector<BenchRatio> ratios = benchRatios(
      {run("room", 26, 128, "hemicube", 1), run("room", 26, 128, "opengl-plain", 3), run("room", 26, 128, "opengl", 12),
       run("room", 26, 512, "hemicube", 1), run("room", 26, 512, "opengl-plain", 5), run("room", 26, 512, "opengl", 4),
       run("room", 800, 128, "hemicube", 1), run("room", 800, 128, "opengl-plain", 6)});
  REQUIRE(ratios.size() == 3);
  CHECK(ratios[0].what == "opengl-plain");
  CHECK(ratios[0].overHemicube == Approx(3));
  CHECK(ratios[1].what == "opengl");
  CHECK(ratios[1].overHemicube == Approx(4));
  CHECK(ratios[2].overHemicube == Approx(6));  // measured alone
}

TEST_CASE("crossovers interpolates the number of triangles from which Embree is faster", "[bench]") {
  // Embree takes twice the time at 100 triangles and half the time at 10,000, so the same time at 1000.
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
