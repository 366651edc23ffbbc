#include <algorithm>
#include <atomic>
#include <thread>

#include "raster/base/parallel.h"
#include "raster/base/thread_group.h"

namespace hemitex::raster {
namespace {

/// The limit that a ThreadLimit has set; 0 means all threads of the machine.
std::atomic<std::size_t>& threadLimit() {
  static std::atomic<std::size_t> limit{0};
  return limit;
}

std::size_t threadCount() {
  const std::size_t limit = threadLimit();
  return limit > 0 ? limit : std::thread::hardware_concurrency();
}

/// Whether the calling thread runs an iteration of a loop that other threads share.
bool& isInLoop() {
  thread_local bool value = false;
  return value;
}

/// During its lifetime, loops of the calling thread stay on it, because the outer loop keeps the other threads busy.
class InLoop {
 public:
  InLoop() : before_(isInLoop()) { isInLoop() = true; }
  ~InLoop() { isInLoop() = before_; }
  InLoop(const InLoop&) = delete;
  InLoop& operator=(const InLoop&) = delete;

 private:
  bool before_;
};

}  // namespace

void parallelFor(std::size_t count, const std::function<void(std::size_t)>& body) {
  const std::size_t threads = threadCount();
  if (count < 2 || threads < 2 || isInLoop()) {
    for (std::size_t i = 0; i < count; ++i) body(i);
    return;
  }
  forEachOnThreads(count, threads, [&body](std::size_t i) {
    const InLoop inLoop;
    body(i);
  });
}

struct ThreadLimit::Implementation {
  std::size_t before = 0;
};

ThreadLimit::ThreadLimit(int threads) {
  if (threads <= 0) return;
  const std::size_t before = threadLimit(), own = static_cast<std::size_t>(threads);
  implementation_.reset(new Implementation{before});
  threadLimit() = before > 0 ? std::min(before, own) : own;
}

ThreadLimit::~ThreadLimit() {
  if (implementation_) threadLimit() = implementation_->before;
}

}  // namespace hemitex::raster
