#include "radiosity/solver/snapshot.h"

#include <bit>
#include <cstring>
#include <type_traits>

#include "raster/base/input_error.h"

namespace hemitex::radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "the format is little-endian");

template <typename Value>
void append(std::string& bytes, const Value& value) {
  static_assert(std::is_standard_layout_v<Value>);
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

template <typename Value>
void append(std::string& bytes, const std::vector<Value>& values) {
  static_assert(std::is_standard_layout_v<Value>);
  append(bytes, std::uint64_t{values.size()});
  bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(Value));
}

/// The next `count` bytes.
std::string_view takeBytes(std::string_view& bytes, std::size_t count) {
  if (count > bytes.size()) throw raster::InputError("the stored solution is cut off");
  const std::string_view taken = bytes.substr(0, count);
  bytes.remove_prefix(count);
  return taken;
}

template <typename Value>
void take(std::string_view& bytes, Value& value) {
  std::memcpy(static_cast<void*>(&value), takeBytes(bytes, sizeof value).data(), sizeof value);
}

template <typename Value>
void take(std::string_view& bytes, std::vector<Value>& values) {
  std::uint64_t count = 0;
  take(bytes, count);
  if (count > bytes.size() / sizeof(Value)) throw raster::InputError("the stored solution is cut off");
  values.resize(count);
  const std::string_view taken = takeBytes(bytes, count * sizeof(Value));
  if (count > 0) std::memcpy(static_cast<void*>(values.data()), taken.data(), taken.size());
}

/// Calls visit(part) for each part of a snapshot.
template <typename AnySnapshot, typename Visit>
void forEachPart(AnySnapshot& snapshot, const Visit& visit) {
  visit(snapshot.shots);
  visit(snapshot.splits);
  visit(snapshot.absorbedByBacks);
  visit(snapshot.state.shot);
  visit(snapshot.state.received);
  visit(snapshot.state.unshot);
  visit(snapshot.state.lost);
  visit(snapshot.state.lostToBacks);
}

}  // namespace

std::string toBytes(const Snapshot& snapshot) {
  std::string bytes;
  forEachPart(snapshot, [&](const auto& part) { append(bytes, part); });
  return bytes;
}

Snapshot takeSnapshot(std::string_view& bytes) {
  Snapshot snapshot;
  forEachPart(snapshot, [&](auto& part) { take(bytes, part); });
  return snapshot;
}

}  // namespace hemitex::radiosity
