// SIMD kernels for small triangles, written with Highway, which compiles this file once per instruction set. Lanes hold
// triangles while covered samples are found, then samples.
#include "raster/kernels/interpolation_bounds.h"
#include "raster/kernels/simd_targets.h"
#include "raster/kernels/small_triangle_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/kernels/small_triangle_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors with the same number of lanes.
using Doubles = hn::CappedTag<double, maxVertexLanes>;
using Floats = hn::Rebind<float, Doubles>;
using Integers = hn::Rebind<std::int32_t, Doubles>;
using Bytes = hn::Rebind<std::uint8_t, Doubles>;
using Double = hn::Vec<Doubles>;
using Float = hn::Vec<Floats>;
using Integer = hn::Vec<Integers>;

constexpr Doubles doubles;
constexpr Floats floats;
constexpr Integers integers;

Double all(double value) { return hn::Set(doubles, value); }
Integer all(std::int32_t value) { return hn::Set(integers, value); }

std::uint32_t bitsOf(hn::Mask<Integers> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(integers, mask, bits);
  return bits[0];
}

hn::Mask<Integers> maskOf(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
  return hn::LoadMaskBits(integers, bytes);
}

/// One vector per corner.
template <typename Value>
struct Corners {
  Value a, b, c;
};

template <typename Tag, typename Value>
Corners<hn::Vec<Tag>> gathered(Tag tag, const Value* values, const Corners<Integer>& at) {
  return {hn::GatherIndex(tag, values, at.a), hn::GatherIndex(tag, values, at.b), hn::GatherIndex(tag, values, at.c)};
}

/// The corners of the triangles of a part, and the covered samples, each packed into one integer.
struct Covered {
  HWY_ALIGN std::int32_t corners[3][largestCluster];
  HWY_ALIGN std::int32_t samples[SmallSamples::most];
  std::size_t count = 0;
};

/// Bits of a packed sample; rows and columns are below 2^12.
constexpr int rowShift = 12, triangleShift = 24;

Integer packed(Integer triangle, Integer row, Integer column) {
  return hn::Or(hn::Or(hn::ShiftLeft<triangleShift>(triangle), hn::ShiftLeft<rowShift>(row)), column);
}

/// The first sample of pixels [first, first + count) between the smallest and the largest snapped value, and the number
/// of such samples.
struct Samples {
  Integer first, count;

  Samples(const Corners<Integer>& at, int scissorFirst, int scissorCount) {
    const Integer least = hn::Min(hn::Min(at.a, at.b), at.c), largest = hn::Max(hn::Max(at.a, at.b), at.c);
    first = hn::Max(hn::ShiftRight<8>(hn::Add(least, all(127))), all(scissorFirst));
    const Integer end = hn::Min(hn::ShiftRight<8>(hn::Add(largest, all(128))), all(scissorFirst + scissorCount));
    count = hn::Sub(end, first);
  }
};

/// Positions relative to the sample of a pixel.
Corners<Integer> fromSample(const Corners<Integer>& at, Integer pixel) {
  const Integer sample = hn::Add(hn::ShiftLeft<8>(pixel), all(128));
  return {hn::Sub(at.a, sample), hn::Sub(at.b, sample), hn::Sub(at.c, sample)};
}

Integer cross(Integer ax, Integer ay, Integer bx, Integer by) { return hn::Sub(hn::Mul(ax, by), hn::Mul(ay, bx)); }

/// An edge from p to q of triangles of positive area. Its value i columns and j rows from the origin is at + right * i
/// + down * j; it is negative if the sample is not covered.
struct SmallEdge {
  Integer at, right, down;

  SmallEdge(Integer px, Integer py, Integer qx, Integer qy) {
    right = hn::ShiftLeft<8>(hn::Sub(py, qy));
    down = hn::ShiftLeft<8>(hn::Sub(qx, px));
    const auto isTop = hn::And(hn::Eq(py, qy), hn::Gt(qx, px));
    const Integer least = hn::IfThenZeroElse(hn::Or(hn::Gt(py, qy), isTop), all(1));
    at = hn::Sub(cross(px, py, qx, qy), least);
  }
};

Corners<Integer> sum(const Corners<Integer>& a, const Corners<Integer>& b) {
  return {hn::Add(a.a, b.a), hn::Add(a.b, b.b), hn::Add(a.c, b.c)};
}

/// Adjacent triangles of a part, from number `from` on, one per lane.
class Group {
 public:
  Group(const SmallTriangles& triangles, std::uint32_t from, hn::Mask<Integers> there, const Scissor& part,
        Covered& covered) {
    const auto corner = [&](std::size_t k) {
      const auto bytes = hn::LoadU(Bytes(), triangles.mesh.corners[k].data() + triangles.part.firstTriangle + from);
      hn::Store(hn::PromoteTo(integers, bytes), integers, covered.corners[k] + from);
      return hn::PromoteTo(integers, bytes);
    };
    const Corners<Integer> at{corner(0), corner(1), corner(2)};
    const Corners<Integer> across = gathered(integers, triangles.placed.across.data(), at);
    const Corners<Integer> down = gathered(integers, triangles.placed.down.data(), at);
    const Samples columns(across, part.column, part.width), rows(down, part.row, part.height);
    setEdges(fromSample(across, columns.first), fromSample(down, rows.first));
    columns_ = columns.count;
    rows_ = hn::IfThenElseZero(hn::AndNot(isFlat_, there), rows.count);
    const Integer triangle = hn::Add(all(static_cast<std::int32_t>(from)), hn::Iota(integers, 0));
    first_ = packed(triangle, rows.first, columns.first);
  }

  hn::Mask<Integers> isNegative() const { return isNegative_; }

  void appendSamples(Covered& covered) const {
    Corners<Integer> edges = at_;
    Integer sample = first_;
    for (int j = 0;; ++j) {
      const auto isRow = hn::Gt(rows_, all(j));
      if (hn::AllFalse(integers, isRow)) return;
      appendRow(edges, sample, hn::IfThenElseZero(isRow, columns_), covered);
      edges = sum(edges, down_);
      sample = hn::Add(sample, all(1 << rowShift));
    }
  }

 private:
  void setEdges(const Corners<Integer>& x, const Corners<Integer>& y) {
    const Integer area = cross(hn::Sub(x.b, x.a), hn::Sub(y.b, y.a), hn::Sub(x.c, x.a), hn::Sub(y.c, y.a));
    isNegative_ = hn::Lt(area, hn::Zero(integers));
    isFlat_ = hn::Eq(area, hn::Zero(integers));
    // Swapping two corners makes a negative area positive.
    const Integer bx = hn::IfThenElse(isNegative_, x.c, x.b), cx = hn::IfThenElse(isNegative_, x.b, x.c);
    const Integer by = hn::IfThenElse(isNegative_, y.c, y.b), cy = hn::IfThenElse(isNegative_, y.b, y.c);
    const SmallEdge a(bx, by, cx, cy), b(cx, cy, x.a, y.a), c(x.a, y.a, bx, by);
    at_ = {a.at, b.at, c.at};
    right_ = {a.right, b.right, c.right};
    down_ = {a.down, b.down, c.down};
  }

  /// `left` is the number of samples per row.
  void appendRow(Corners<Integer> edges, Integer sample, Integer left, Covered& covered) const {
    const Integer one = all(1);
    for (; !hn::AllFalse(integers, hn::Gt(left, hn::Zero(integers))); left = hn::Sub(left, one)) {
      // The sign bit is clear if all four values are at least 0.
      const Integer signs = hn::Or(hn::Or(edges.a, edges.b), hn::Or(edges.c, hn::Sub(left, one)));
      const auto isCovered = hn::Gt(signs, all(-1));
      hn::StoreU(hn::Compress(sample, isCovered), integers, covered.samples + covered.count);
      covered.count += hn::CountTrue(integers, isCovered);
      edges = sum(edges, right_);
      sample = hn::Add(sample, one);
    }
  }

  // Initialized here, because an implicit constructor would not be compiled for the instruction set.
  Corners<Integer> at_{all(0), all(0), all(0)}, right_ = at_, down_ = at_;  ///< of the edges, see SmallEdge
  Integer rows_, columns_;                                                  ///< number of samples that may be covered
  Integer first_;                                                           ///< the first of these samples
  hn::Mask<Integers> isNegative_, isFlat_;
};

Double dot(const Corners<Double>& a, const Corners<Double>& b) {
  return hn::Add(hn::Add(hn::Mul(a.a, b.a), hn::Mul(a.b, b.b)), hn::Mul(a.c, b.c));
}

Corners<Double> promoted(const Corners<Float>& of) {
  return {hn::PromoteTo(doubles, of.a), hn::PromoteTo(doubles, of.b), hn::PromoteTo(doubles, of.c)};
}

Corners<Double> promoted(const Corners<Integer>& of) {
  return {hn::PromoteTo(doubles, of.a), hn::PromoteTo(doubles, of.b), hn::PromoteTo(doubles, of.c)};
}

/// A texture coordinate, as SmallTexel in small_triangle_kernels.cpp.
struct SmallTexel {
  Double texel;
  hn::Mask<Doubles> isClear;

  SmallTexel(const Corners<Double>& weights, Double inverseSum, const Corners<Double>& coordinate, int texels) {
    const Double size = all(static_cast<double>(texels));
    const Double position = hn::Mul(hn::Mul(dot(weights, coordinate), inverseSum), size);
    const Double largest =
        hn::Mul(hn::Max(hn::Max(hn::Abs(coordinate.a), hn::Abs(coordinate.b)), hn::Abs(coordinate.c)), size);
    const Double whole = hn::Floor(position), clear = hn::Sub(all(0.5), hn::Mul(all(depthError), largest));
    const Double offCentre = hn::Abs(hn::Sub(hn::Sub(position, whole), all(0.5)));
    isClear = hn::Or(hn::Lt(offCentre, clear), hn::Eq(size, all(1.0)));
    texel = hn::Max(hn::Min(whole, hn::Sub(size, all(1.0))), hn::Zero(doubles));
  }
};

/// Computes 1/w and texels of adjacent samples, from the `i`th on.
void show(const SmallTriangles& triangles, const Covered& covered, std::size_t i, SmallSamples& samples) {
  const Integer sample = hn::Load(integers, covered.samples + i), low = all((1 << rowShift) - 1);
  const Integer triangle = hn::ShiftRight<triangleShift>(sample);
  const Integer row = hn::And(hn::ShiftRight<rowShift>(sample), low), column = hn::And(sample, low);
  hn::StoreU(triangle, integers, samples.triangles.data() + i);
  hn::StoreU(row, integers, samples.rows.data() + i);
  hn::StoreU(column, integers, samples.columns.data() + i);

  const auto corner = [&](std::size_t k) { return hn::GatherIndex(integers, covered.corners[k], triangle); };
  const Corners<Integer> at{corner(0), corner(1), corner(2)};
  const Corners<Integer> x = fromSample(gathered(integers, triangles.placed.across.data(), at), column);
  const Corners<Integer> y = fromSample(gathered(integers, triangles.placed.down.data(), at), row);
  const Corners<Double> w = promoted(gathered(floats, triangles.placed.w.data(), at));
  const Corners<Double> e = promoted({cross(x.b, y.b, x.c, y.c), cross(x.c, y.c, x.a, y.a), cross(x.a, y.a, x.b, y.b)});
  const Double area = hn::Add(hn::Add(e.a, e.b), e.c), product = hn::Mul(hn::Mul(w.a, w.b), w.c);
  const Corners<Double> weights{hn::Mul(e.a, hn::Mul(w.b, w.c)), hn::Mul(e.b, hn::Mul(w.c, w.a)),
                                hn::Mul(e.c, hn::Mul(w.a, w.b))};
  const Double sum = hn::Add(hn::Add(weights.a, weights.b), weights.c);
  hn::StoreU(hn::Div(sum, hn::Mul(product, area)), doubles, samples.inverseDepths.data() + i);

  if (triangles.columns == 1 && triangles.rows == 1) {
    hn::StoreU(hn::Zero(integers), integers, samples.texels.data() + i);
    return;
  }
  const Double inverseSum = hn::Div(all(1.0), sum);
  const float* const texcoords = &triangles.mesh.texcoords[triangles.part.firstVertex].x;
  const Corners<Integer> pair{hn::Add(at.a, at.a), hn::Add(at.b, at.b), hn::Add(at.c, at.c)};
  const SmallTexel across(weights, inverseSum, promoted(gathered(floats, texcoords, pair)), triangles.columns);
  const SmallTexel down(weights, inverseSum, promoted(gathered(floats, texcoords + 1, pair)), triangles.rows);
  const Double texel = hn::Add(hn::Mul(down.texel, all(static_cast<double>(triangles.columns))), across.texel);
  const Double undecided = all(static_cast<double>(undecidedTexel));
  const Double told = hn::IfThenElse(hn::And(across.isClear, down.isClear), texel, undecided);
  hn::StoreU(hn::DemoteTo(integers, told), integers, samples.texels.data() + i);
}

void findSamples(const SmallTriangles& triangles, const Scissor& part, SmallSamples& samples) {
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(integers));
  Covered covered;
  samples.negative = 0;
  for (std::uint32_t from = 0; from < triangles.part.triangles; from += lanes) {
    const std::uint32_t bits = triangles.set >> from & ((1U << lanes) - 1);
    if (bits == 0) continue;
    const Group group(triangles, from, maskOf(bits), part, covered);
    group.appendSamples(covered);
    samples.negative |= bitsOf(group.isNegative()) << from;
  }
  samples.count = covered.count;
  // Pads with the last sample.
  hn::StoreU(all(covered.samples[std::max(covered.count, std::size_t{1}) - 1]), integers,
             covered.samples + covered.count);
  for (std::size_t i = 0; i < covered.count; i += lanes) show(triangles, covered, i, samples);
}

SmallTriangleKernels smallTriangleKernels() { return {hwy::TargetName(HWY_TARGET), findSamples}; }

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hemitex::raster {
namespace {

HWY_EXPORT(smallTriangleKernels);

}  // namespace

template <>
const std::vector<SmallTriangleKernels>& simdKernels<SmallTriangleKernels>() {
  static const std::vector<SmallTriangleKernels> all =
      ofEveryInstructionSet<SmallTriangleKernels>([] { return HWY_DYNAMIC_DISPATCH(smallTriangleKernels)(); });
  return all;
}

}  // namespace hemitex::raster
#endif
