/// Scratch memory that is reused. There are as many values as were in use at a time, however many threads came and
/// went. Results must not depend on which value they were computed with.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

namespace hemitex::raster {

template <typename Value>
class Pool {
 public:
  Pool() = default;
  /// `make` makes a value.
  explicit Pool(std::function<Value()> make) : make_(std::move(make)) {}

  /// Calls body(value) with a value that no other call uses meanwhile. May be called from several threads at a time.
  template <typename Body>
  void with(const Body& body) {
    std::unique_ptr<Value> value = take();
    body(*value);
    const std::lock_guard lock(mutex_);
    unused_.push_back(std::move(value));
  }

  /// All values; none may be in use.
  std::vector<std::unique_ptr<Value>>& values() { return unused_; }
  const std::vector<std::unique_ptr<Value>>& values() const { return unused_; }

 private:
  std::unique_ptr<Value> take() {
    const std::lock_guard lock(mutex_);
    if (unused_.empty()) return std::unique_ptr<Value>(new Value(make_()));
    std::unique_ptr<Value> value = std::move(unused_.back());
    unused_.pop_back();
    return value;
  }

  std::function<Value()> make_ = [] { return Value(); };
  std::vector<std::unique_ptr<Value>> unused_;
  std::mutex mutex_;
};

}  // namespace hemitex::raster
