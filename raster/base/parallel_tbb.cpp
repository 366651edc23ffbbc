#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include "raster/base/parallel.h"

namespace hemitex::raster {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  using Range = tbb::blocked_range<std::size_t>;
  // Small chunks balance the load: a thread without work waits at most for one chunk. Long loops have short iterations,
  // so that their chunks may hold more of them.
  constexpr std::size_t pieces = 512;
  tbb::parallel_for(
      Range(0, count, 1 + count / pieces),
      [&body](const Range& range) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) body(i);
      },
      tbb::simple_partitioner());
}

struct ThreadLimit::Implementation {
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0)
    implementation_.reset(new Implementation{
        tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads))});
}

ThreadLimit::~ThreadLimit() = default;

}  // namespace hemitex::raster
