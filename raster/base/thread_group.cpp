#include "raster/base/thread_group.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace hemitex::raster {

void forEachOnThreads(std::size_t count, std::size_t threads, const std::function<void(std::size_t)>& body) {
  std::atomic<std::size_t> next{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto work = [&] {
    try {
      for (std::size_t k = next++; k < count; k = next++) body(k);
    } catch (...) {
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
      next = count;
    }
  };
  {
    std::vector<std::thread> others;
    try {
      for (std::size_t k = 1; k < std::min(threads, count); ++k) others.emplace_back(work);
    } catch (const std::exception&) {
      // The system starts no more threads, or there is no memory for them.
    }
    work();
    for (std::thread& other : others) other.join();
  }
  if (failure) std::rethrow_exception(failure);
}

}  // namespace hemitex::raster
