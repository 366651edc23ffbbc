/// One value per thread that asks for one, for example scratch memory that stays in the cache of its core. The values
/// are destroyed with this object, not at the end of the thread. Results must not depend on which thread computed them.
#pragma once

#include <map>
#include <mutex>
#include <thread>

namespace hemitex::raster {

template <typename Value>
class PerThread {
 public:
  /// Returns the value of the calling thread. The first call of a thread constructs it from the arguments.
  template <typename... Arguments>
  Value& mine(const Arguments&... arguments) {
    const std::lock_guard lock(mutex_);
    return values_.try_emplace(std::this_thread::get_id(), arguments...).first->second;
  }

  /// The values of all threads. No other thread may call mine() at the same time.
  std::map<std::thread::id, Value>& all() { return values_; }
  const std::map<std::thread::id, Value>& all() const { return values_; }

 private:
  std::map<std::thread::id, Value> values_;
  std::mutex mutex_;
};

}  // namespace hemitex::raster
