/// Values as bytes in memory order, for files of this program, for messages between its processes, and for hashes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "raster/base/input_error.h"

namespace hemitex::radiosity {

/// Appends the bytes of a value. Values in files and hashes have no padding.
template <typename Value>
void appendBytes(std::string& bytes, const Value& value) {
  static_assert(std::is_standard_layout_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Removes the first `count` bytes and returns them. Throws InputError if there are fewer.
inline std::string_view takeBytes(std::string_view& bytes, std::size_t count) {
  if (count > bytes.size()) throw raster::InputError("is cut off");
  const std::string_view taken = bytes.substr(0, count);
  bytes.remove_prefix(count);
  return taken;
}

/// Removes a value that appendBytes wrote, and returns it. Throws InputError if there are too few bytes.
template <typename Value>
requires(!requires { typename Value::allocator_type; }) Value takeValue(std::string_view& bytes) {
  static_assert(std::is_standard_layout_v<Value>);
  Value value;
  std::memcpy(static_cast<void*>(&value), takeBytes(bytes, sizeof value).data(), sizeof value);
  return value;
}

/// Appends the number of values and their bytes.
template <typename Value>
void appendBytes(std::string& bytes, const std::vector<Value>& values) {
  static_assert(std::is_standard_layout_v<Value>);
  appendBytes(bytes, std::uint64_t{values.size()});
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

/// As above, of a std::vector.
template <typename List>
requires requires { typename List::allocator_type; }
List takeValue(std::string_view& bytes) {
  using Value = typename List::value_type;
  static_assert(std::is_standard_layout_v<Value>);
  const auto count = takeValue<std::uint64_t>(bytes);
  if (count > bytes.size() / sizeof(Value)) throw raster::InputError("is cut off");
  List values(count);
  if (count > 0)
    std::memcpy(static_cast<void*>(values.data()), takeBytes(bytes, count * sizeof(Value)).data(),
                count * sizeof(Value));
  return values;
}

}  // namespace hemitex::radiosity
