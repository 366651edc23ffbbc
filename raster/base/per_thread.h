/// A value for each thread that asks for one, which it finds again and no other thread has: memory that stays in its
/// cache, and is given back with this and not when the thread ends. Nothing that is computed may depend on which thread
/// computed it.
#pragma once

#include <map>
#include <mutex>
#include <thread>

namespace hemitex::raster {

template <typename Value>
class PerThread {
 public:
  /// Of the calling thread; made of the arguments when it asks for the first time.
  template <typename... Arguments>
  Value& mine(const Arguments&... arguments) {
    const std::lock_guard lock(mutex_);
    return values_.try_emplace(std::this_thread::get_id(), arguments...).first->second;
  }

  /// Of all threads that asked; none may be asking now.
  std::map<std::thread::id, Value>& all() { return values_; }
  const std::map<std::thread::id, Value>& all() const { return values_; }

 private:
  std::map<std::thread::id, Value> values_;
  std::mutex mutex_;
};

}  // namespace hemitex::raster
