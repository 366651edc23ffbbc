#include "radiosity/solver/snapshot.h"

#include <bit>

#include "radiosity/base/bytes.h"

namespace hemitex::radiosity {
namespace {

static_assert(std::endian::native == std::endian::little, "the format is little-endian");

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
  forEachPart(snapshot, [&](const auto& part) { appendBytes(bytes, part); });
  return bytes;
}

Snapshot takeSnapshot(std::string_view& bytes) {
  Snapshot snapshot;
  forEachPart(snapshot, [&]<typename Part>(Part& part) { part = takeValue<Part>(bytes); });
  return snapshot;
}

}  // namespace hemitex::radiosity
