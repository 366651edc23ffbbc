#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include "raster/parallel.h"

namespace hemitex::raster {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  tbb::parallel_for(std::size_t{0}, count, body);
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
