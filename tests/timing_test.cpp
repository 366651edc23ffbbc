// Who is timed when; how long is no matter of a test.
#include "reference/timing.h"

#include <catch2/catch.hpp>
#include <string>

using namespace hemitex::reference;

TEST_CASE("what is timed runs once without the clock and then in turns", "[bench]") {
  std::string calls;
  const std::vector<std::function<void()>> tasks{[&] { calls += 'a'; }, [&] { calls += 'b'; }};
  const std::vector<Timing> timings = timeInTurns(tasks, 3);
  CHECK(calls == "abababab");
  REQUIRE(timings.size() == 2);
  for (const Timing& timing : timings) {
    CHECK(timing.repeats == 3);
    CHECK(timing.least >= 0);
    CHECK(timing.median >= timing.least);
  }
}

TEST_CASE("the median of an even number of times lies between the middle ones", "[bench]") {
  CHECK(timingOf({3, 1, 2}).median == 2);
  CHECK(timingOf({4, 1, 3, 2}).median == 2.5);
  CHECK(timingOf({4, 1, 3, 2}).least == 1);
}
