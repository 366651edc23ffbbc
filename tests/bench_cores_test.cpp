// What is compared with two threads runs on one.
#include "reference/bench_cores.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "raster/parallel.h"

using namespace hemitex;

TEST_CASE("every task runs on one thread and then on two, in turns", "[bench]") {
  constexpr int repeats = 2;
  std::vector<std::size_t> calls;       // which task
  std::vector<bool> stayedOnItsThread;  // one a call
  const auto task = [&](std::size_t number) {
    return [&, number] {
      const std::thread::id caller = std::this_thread::get_id();
      std::atomic<bool> stayed = true;
      raster::parallelFor(16, [&](std::size_t) {
        // Another thread, were there one, would come meanwhile.
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        if (std::this_thread::get_id() != caller) stayed = false;
      });
      calls.push_back(number);
      stayedOnItsThread.push_back(stayed);
    };
  };
  const auto gains =
      reference::gainsOfSecondCore(std::vector<std::function<void()>>{task(0), task(1), task(2)}, repeats);
  CHECK(gains.size() == 3);
  // Once before the clock runs, then the repeats.
  REQUIRE(calls.size() == 3 * 2 * (1 + repeats));
  for (std::size_t call = 0; call < calls.size(); ++call) {
    CHECK(calls[call] == call / 2 % 3);
    if (call % 2 == 0) CHECK(stayedOnItsThread[call]);
  }
}
