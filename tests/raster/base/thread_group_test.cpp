// forEachOnThreads runs each iteration once on at most the given threads, and hands on exceptions.
#include "raster/base/thread_group.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace hemitex::raster;

TEST_CASE("forEachOnThreads calls its body once for each number below the count", "[thread_group]") {
  for (const std::size_t threads : {0, 1, 2, 7})
    for (const std::size_t count : {0, 1, 2, 5, 1000}) {
      CAPTURE(threads, count);
      std::vector<std::atomic<int>> calls(count);
      forEachOnThreads(count, threads, [&calls](std::size_t k) { ++calls.at(k); });
      std::size_t once = 0;
      for (const std::atomic<int>& of : calls) once += of == 1 ? 1 : 0;
      CHECK(once == count);
    }
}

TEST_CASE("forEachOnThreads uses as many threads as given, if there is work for all", "[thread_group]") {
  // Each iteration waits until all three run, so that no thread can take two of them.
  std::atomic<int> running{0};
  std::set<std::thread::id> threads;
  std::mutex mutex;
  forEachOnThreads(3, 3, [&](std::size_t) {
    ++running;
    while (running < 3) std::this_thread::yield();
    const std::lock_guard lock(mutex);
    threads.insert(std::this_thread::get_id());
  });
  CHECK(threads.size() == 3);
  CHECK(threads.count(std::this_thread::get_id()) == 1);
}

TEST_CASE("forEachOnThreads ends its threads before it throws the exception of an iteration", "[thread_group]") {
  for (const std::size_t threads : {1, 2, 7}) {
    CAPTURE(threads);
    std::atomic<int> running{0}, calls{0};
    const auto body = [&](std::size_t k) {
      ++running;
      ++calls;
      if (k == 3) {
        --running;
        throw std::runtime_error("iteration 3");
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      --running;
    };
    CHECK_THROWS_WITH(forEachOnThreads(1000, threads, body), "iteration 3");
    CHECK(running == 0);
    CHECK(calls < 1000);
  }
}
