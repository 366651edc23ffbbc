/// The bytes of a message: values and lists one behind the other, as they lie in memory. All ranks run the same program
/// on machines of one kind.
#pragma once

#include <cassert>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace hemitex::radiosity {

/// Whether copied bytes are a copy of the value. GLM's vectors have copy constructors of their own, which copy the
/// bytes.
template <typename Value>
inline constexpr bool isPlain = std::is_standard_layout_v<Value>&& std::is_trivially_destructible_v<Value>;

class MessageWriter {
 public:
  template <typename Value>
  void add(const Value& value) {
    static_assert(isPlain<Value>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <typename Value>
  void add(const std::vector<Value>& values) {
    static_assert(isPlain<Value>);
    add(std::uint64_t{values.size()});
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Reads what a MessageWriter of the same program wrote, in the same order. The bytes must outlive it.
class MessageReader {
 public:
  explicit MessageReader(std::string_view bytes) : bytes_(bytes) {}

  template <typename Value>
  Value value() {
    static_assert(isPlain<Value>);
    Value value;
    copy(&value, sizeof value);
    return value;
  }
  template <typename Value>
  std::vector<Value> list() {
    std::vector<Value> values(static_cast<std::size_t>(value<std::uint64_t>()));
    copy(values.data(), values.size() * sizeof(Value));
    return values;
  }
  std::string_view rest() const { return bytes_; }

 private:
  void copy(void* target, std::size_t size) {
    assert(size <= bytes_.size());
    if (size > 0) std::memcpy(target, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }

  std::string_view bytes_;
};

}  // namespace hemitex::radiosity
