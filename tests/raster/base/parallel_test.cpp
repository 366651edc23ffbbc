// parallelFor runs each iteration once, however it distributes them over threads.
#include "raster/base/parallel.h"

#include <atomic>
#include <catch2/catch.hpp>
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
