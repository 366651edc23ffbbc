// The order and number of timed calls. Tests do not check durations.
#include "reference/measurement/bench/timing.h"

#include <array>
#include <catch2/catch.hpp>
#include <string>

using namespace hemitex::reference;

TEST_CASE("shortTaskTimings runs each task once before the measurement and then in interleaved repetitions",
          "[bench]") {
  std::string calls;
  const std::vector<std::function<void()>> tasks{[&] { calls += 'a'; }, [&] { calls += 'b'; }};
  const std::vector<Timing> timings = shortTaskTimings(tasks, 3, 0);
  CHECK(calls == "abababab");
  REQUIRE(timings.size() == 2);
  for (const Timing& timing : timings) {
    CHECK(timing.repetitions.size() == 3);
    CHECK(timing.min >= 0);
    CHECK(timing.median >= timing.min);
  }
}

TEST_CASE("shortTaskTimings calls a short task again until its repetition is long enough", "[bench]") {
  std::string calls;
  const std::vector<std::function<void()>> tasks{[&] { calls += 'a'; }, [&] { calls += 'b'; }};
  const Timing timing = shortTaskTimings(tasks, 1, 0.05).front();
  const std::size_t turnOfA = calls.find('b', 2), a = turnOfA - 2, b = calls.size() - turnOfA;
  INFO(a << " and " << b << " calls");
  CHECK(calls == "ab" + std::string(a, 'a') + std::string(b, 'b'));
  // Thousands of calls fit into 50 ms; the mean times their number is at least 50 ms.
  CHECK(a > 1);
  CHECK(b > 1);
  CHECK(timing.median * static_cast<double>(a) >= Approx(0.05));
}

TEST_CASE("interleavedTimings does not repeat a long task", "[bench]") {
  std::string calls;
  const std::vector<Timing> timings = interleavedTimings(
      3, 3,
      [&](std::size_t task, int repetition) {
        calls += static_cast<char>('a' + task);
        return static_cast<double>(task) + repetition;
      },
      1);
  CHECK(calls == "abcabab");
  CHECK(timings[0].repetitions == std::vector<double>{0, 1, 2});
  CHECK(timings[1].median == 2);
  CHECK(timings[2].repetitions == std::vector<double>{2});
}

TEST_CASE("timingOf has the median of the times, the mean of the middle two of an even number, and the minimum",
          "[bench]") {
  CHECK(timingOf({3, 1, 2}).median == 2);
  CHECK(timingOf({4, 1, 3, 2}).median == 2.5);
  CHECK(timingOf({4, 1, 3, 2}).min == 1);
}

TEST_CASE("ratioOf is the median of the ratios of each repetition", "[bench]") {
  // One task takes three times as long as the other. The machine is half as fast from the second of four repetitions
  // on, but not yet for the other task in the second one. So the ratio of medians would be 6 / 1.5.
  const Timing timing = timingOf({3, 6, 6, 6}), other = timingOf({1, 1, 2, 2});
  CHECK(ratioOf(timing, other) == 3);
  CHECK(timing.median / other.median == 4);
  CHECK(ratioOf(timing / 2, other) == 1.5);
}

TEST_CASE("shortTaskTimings warms a task up before each of its repetitions", "[bench]") {
  std::string calls;
  const std::vector<std::function<void()>> tasks{[&] { calls += 'a'; }, [&] { calls += 'b'; }};
  const std::array<double, 2> warmUps{0, 1e-12};
  const std::vector<Timing> timings = shortTaskTimings(tasks, 3, 0, warmUps);
  CHECK(timings[1].repetitions.size() == 3);
  CHECK(calls == "ababbabbabb");
}
