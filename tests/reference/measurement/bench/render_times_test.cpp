// Ratios of given times.
#include "reference/measurement/bench/render_times.h"

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

TEST_CASE("overHemicube compares with the hemicube of the same scene, triangles and resolution", "[bench]") {
  const std::vector<BenchRun> runs{run("room", 26, 128, "hemicube", 1),   run("room", 26, 128, "embree", 6),
                                   run("room", 26, 512, "hemicube", 10),  run("room", 26, 512, "embree", 55),
                                   run("room", 8000, 128, "hemicube", 2), run("room", 8000, 128, "floor", 0.5)};
  CHECK(overHemicube(runs[1], runs).value() == Approx(6));
  CHECK(overHemicube(runs[3], runs).value() == Approx(5.5));
  CHECK(overHemicube(runs[5], runs).value() == Approx(0.25));
  CHECK_FALSE(overHemicube(runs[0], runs));
  CHECK_FALSE(overHemicube(run("room", 26, 128, "solution", 9), runs));   // chooses other patches
  CHECK_FALSE(overHemicube(run("gallery", 26, 128, "embree", 6), runs));  // has no hemicube
}

TEST_CASE("overHemicube has the faster of both OpenGL paths only", "[bench]") {
  const std::vector<BenchRun> runs{run("room", 26, 128, "hemicube", 1),     run("room", 26, 128, "opengl-plain", 3),
                                   run("room", 26, 128, "opengl", 12),      run("room", 26, 512, "hemicube", 1),
                                   run("room", 26, 512, "opengl-plain", 5), run("room", 26, 512, "opengl", 4)};
  CHECK(overHemicube(runs[1], runs).value() == Approx(3));
  CHECK_FALSE(overHemicube(runs[2], runs));
  CHECK_FALSE(overHemicube(runs[4], runs));
  CHECK(overHemicube(runs[5], runs).value() == Approx(4));
  CHECK(overHemicube(run("gallery", 26, 128, "opengl", 9), {run("gallery", 26, 128, "hemicube", 1)}).value() ==
        Approx(9));  // measured alone
}
