// parallelFor runs each iteration once, however it distributes them over threads. The tests run with oneTBB and, in
// another build, with standard threads.
#include "raster/base/parallel.h"

#include <atomic>
#include <catch2/catch.hpp>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

using namespace hemitex::raster;

TEST_CASE("parallelFor calls its body once for each number below the count", "[parallel]") {
  for (const int threads : {1, 2, 0})
    for (const std::size_t count : {0, 1, 2, 511, 512, 513, 100003}) {
      CAPTURE(threads, count);
      const ThreadLimit limit(threads);
      std::vector<std::atomic<int>> calls(count);
      parallelFor(count, [&calls](std::size_t i) { ++calls.at(i); });
      std::size_t once = 0;
      for (const std::atomic<int>& of : calls) once += of == 1 ? 1 : 0;
      CHECK(once == count);
    }
}

TEST_CASE("parallelFor runs inside its own iterations", "[parallel]") {
  std::vector<std::atomic<int>> calls(64 * 64);
  parallelFor(64, [&](std::size_t i) { parallelFor(64, [&](std::size_t j) { ++calls.at(64 * i + j); }); });
  std::size_t once = 0;
  for (const std::atomic<int>& of : calls) once += of == 1 ? 1 : 0;
  CHECK(once == calls.size());
}

TEST_CASE("parallelFor throws the exception of an iteration, and the next loop is whole again", "[parallel]") {
  const auto fail = [](std::size_t i) {
    if (i == 7) throw std::runtime_error("iteration 7");
  };
  CHECK_THROWS_WITH(parallelFor(100, fail), "iteration 7");
  std::atomic<int> calls{0};
  parallelFor(100, [&calls](std::size_t) { ++calls; });
  CHECK(calls == 100);
}

TEST_CASE("ThreadLimit bounds the threads of parallelFor until its end", "[parallel]") {
  const auto threadsOf = [](std::size_t count) {
    std::set<std::thread::id> threads;
    std::mutex mutex;
    parallelFor(count, [&](std::size_t) {
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
    return threads;
  };
  const ThreadLimit two(2);
  {
    const ThreadLimit one(1);
    CHECK(threadsOf(1000) == std::set{std::this_thread::get_id()});
    const ThreadLimit four(4);  // the lowest limit holds
    CHECK(threadsOf(1000) == std::set{std::this_thread::get_id()});
  }
  CHECK(threadsOf(1000).size() <= 2);
}
