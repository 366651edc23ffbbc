// Speed-ups from one to two threads.
#include "reference/measurement/bench/thread_scaling.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "raster/base/parallel.h"

using namespace hemitex;

TEST_CASE("coreGains compares with arithmetic in each repetition", "[bench]") {
  // In one repetition the second core is half as fast, also for arithmetic.
  const reference::CoreGains gains = reference::coreGains({2, 2, 1}, {1.8, 0.9, 0.9}, {1, 2, 1});
  CHECK(gains.arithmetic == 2);
  CHECK(gains.hemicube == 0.9);
  CHECK(gains.solution == 1);
  CHECK(gains.hemicubeOfArithmetic == 0.9);
  CHECK(gains.solutionOfArithmetic == 1);
}

TEST_CASE("gainsOfSecondCore runs each task on one thread and then on two, in interleaved repetitions", "[bench]") {
  constexpr int repeats = 2;
  struct Turns {  // calls of a task, first on one thread and then on two; their number depends on the clock
    std::size_t task;
    bool beginOnOneThread;
    int calls = 0;
  };
  std::vector<Turns> turns;
  const auto task = [&](std::size_t number) {
    return [&, number] {
      const std::thread::id caller = std::this_thread::get_id();
      std::atomic<bool> stayed = true;
      raster::parallelFor(16, [&](std::size_t) {
        // A second thread would take the next part meanwhile.
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (std::this_thread::get_id() != caller) stayed = false;
      });
      if (turns.empty() || turns.back().task != number) turns.push_back({number, stayed});
      ++turns.back().calls;
    };
  };
  const auto gains =
      reference::gainsOfSecondCore(std::vector<std::function<void()>>{task(0), task(1), task(2)}, repeats);
  REQUIRE(gains.size() == 3);
  for (const std::vector<double>& ofTask : gains) CHECK(ofTask.size() == repeats);
  // Once before the measurement, then the repetitions.
  REQUIRE(turns.size() == 3 * (1 + repeats));
  for (std::size_t i = 0; i < turns.size(); ++i) {
    CHECK(turns[i].task == i % 3);
    CHECK(turns[i].beginOnOneThread);
    CHECK(turns[i].calls >= 2);
  }
}
