/// Kernels for runs of equal item IDs.
// No include guard: kernels.cpp includes this file once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE::runs {
namespace {

using ItemIds = hn::CappedTag<std::uint32_t, 16>;

constexpr ItemIds idLanes;

/// One bit per item ID of a vector, from bit 0 on: set if it differs from the item ID before it.
std::uint64_t changesOfVector(const ItemId* ids) {
  const auto differ = hn::Ne(hn::LoadU(idLanes, ids), hn::LoadU(idLanes, ids - 1));
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(idLanes, differ, bits);
  return bits[0] + 256U * bits[1];
}

void findChanges(const ItemId* ids, std::size_t count, std::uint64_t* changes) {
  const std::size_t lanes = hn::Lanes(idLanes);
  std::size_t first = 0;
  for (; first + changesAtOnce <= count; first += changesAtOnce) {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < changesAtOnce; i += lanes) bits |= changesOfVector(ids + first + i) << i;
    *changes++ = bits;
  }
  if (first == count) return;
  *changes = 0;
  for (std::size_t i = first; i < count; ++i) *changes |= std::uint64_t{ids[i] != *(ids + i - 1)} << (i - first);
}

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE::runs
HWY_AFTER_NAMESPACE();
