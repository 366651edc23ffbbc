/// A parallel loop with independent iterations. It runs on oneTBB, or on standard threads in a build without oneTBB.
/// Results must not depend on how the iterations are distributed over threads.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace hemitex::raster {

/// Calls body(0) to body(count - 1) once each, in any order and on any thread. Returns when all calls have returned.
void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body);

/// During its lifetime, parallelFor uses at most this number of threads; 0 means all threads of the machine.
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
