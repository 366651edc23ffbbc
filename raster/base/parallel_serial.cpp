#include "raster/base/parallel.h"

namespace hemitex::raster {

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

struct ThreadLimit::Implementation {};

ThreadLimit::ThreadLimit(int) {}

ThreadLimit::~ThreadLimit() = default;

}  // namespace hemitex::raster
