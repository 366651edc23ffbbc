/// Types and functions of all kernels: vectors of up to eight lanes, as many as the instruction set has.
// No include guard: kernels.cpp includes this file once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors with the same number of lanes.
using Doubles = hn::CappedTag<double, maxVertexLanes>;
using Floats = hn::Rebind<float, Doubles>;
using Integers = hn::Rebind<std::int32_t, Doubles>;
using Numbers = hn::Rebind<std::uint32_t, Doubles>;
using Bytes = hn::Rebind<std::uint8_t, Doubles>;
using Double = hn::Vec<Doubles>;
using Float = hn::Vec<Floats>;
using Integer = hn::Vec<Integers>;
using Mask = hn::Mask<Doubles>;

constexpr Doubles doubles;
constexpr Floats floats;
constexpr Integers integers;

Float all(float value) { return hn::Set(floats, value); }
Double all(double value) { return hn::Set(doubles, value); }
Integer all(std::int32_t value) { return hn::Set(integers, value); }

Mask firstLanes(int count) { return hn::FirstN(doubles, static_cast<std::size_t>(count)); }

/// A mask as one bit per lane.
template <typename Tag>
std::uint8_t bitsOf(Tag tag, hn::Mask<Tag> mask) {
  HWY_ALIGN std::uint8_t bits[8] = {};
  hn::StoreMaskBits(tag, mask, bits);
  return bits[0];
}

/// Converts a mask to lanes of 32-bit numbers.
hn::Mask<Numbers> forNumbers(const Mask mask) {
  HWY_ALIGN std::uint8_t bits[8] = {};
  hn::StoreMaskBits(doubles, mask, bits);
  return hn::LoadMaskBits(Numbers(), bits);
}

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
