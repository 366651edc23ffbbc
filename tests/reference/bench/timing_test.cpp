// Who is timed when; how long is no matter of a test.
#include "reference/bench/timing.h"

#include <catch2/catch.hpp>
#include <string>

using namespace hemitex::reference;

TEST_CASE("what is timed runs once without the clock and then in turns", "[bench]") {
  std::string calls;
  const std::vector<std::function<void()>> tasks{[&] { calls += 'a'; }, [&] { calls += 'b'; }};
  const std::vector<Timing> timings = timeInTurns(tasks, 3, 0);
  CHECK(calls == "abababab");
  REQUIRE(timings.size() == 2);
  for (const Timing& timing : timings) {
    CHECK(timing.turns.size() == 3);
    CHECK(timing.least >= 0);
    CHECK(timing.median >= timing.least);
  }
}

TEST_CASE("what is short is called again in its turn until it is long enough", "[bench]") {
  std::string calls;
  const std::vector<std::function<void()>> tasks{[&] { calls += 'a'; }, [&] { calls += 'b'; }};
  const Timing timing = timeInTurns(tasks, 1, 0.05).front();
  const std::size_t turnOfA = calls.find('b', 2), a = turnOfA - 2, b = calls.size() - turnOfA;
  INFO(a << " and " << b << " calls");
  CHECK(calls == "ab" + std::string(a, 'a') + std::string(b, 'b'));
  // Thousands fit into 50 ms; together they take that long, as the mean call says.
  CHECK(a > 1);
  CHECK(b > 1);
  CHECK(timing.median * static_cast<double>(a) >= Approx(0.05));
}

TEST_CASE("the median of an even number of times lies between the middle ones", "[bench]") {
  CHECK(timingOf({3, 1, 2}).median == 2);
  CHECK(timingOf({4, 1, 3, 2}).median == 2.5);
  CHECK(timingOf({4, 1, 3, 2}).least == 1);
}

TEST_CASE("a ratio is that of turns, whatever the machine's pace in each", "[bench]") {
  // One takes three times as long as the other. The machine is half as fast from the second of four turns on, the other
  // misses that in its own second turn: the medians' ratio would be 6 / 1.5.
  const Timing timing = timingOf({3, 6, 6, 6}), other = timingOf({1, 1, 2, 2});
  CHECK(ratioOf(timing, other) == 3);
  CHECK(timing.median / other.median == 4);
  CHECK(ratioOf(timing / 2, other) == 1.5);
}
