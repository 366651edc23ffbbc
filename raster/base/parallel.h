/// Threads: a loop whose iterations are independent, on oneTBB where it is there and in order where it is not.
/// Nothing that is computed may depend on how the iterations are spread.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace hemitex::raster {

/// Calls body(0) ... body(count - 1), each once, in any order and on any thread; returns when all are done.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// While it lives, parallelFor uses at most this many threads; 0 means as many as the machine has.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace hemitex::raster
