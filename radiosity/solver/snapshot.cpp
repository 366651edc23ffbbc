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
  for (auto* table :
       {&snapshot.absorbedByBacks, &snapshot.state.shot, &snapshot.state.received, &snapshot.state.unshot}) {
    visit(table->bands);
    visit(table->values);
  }
  for (auto* sum : {&snapshot.state.lost, &snapshot.state.lostToBacks}) {
    visit(sum->sum);
    visit(sum->rest);
  }
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
