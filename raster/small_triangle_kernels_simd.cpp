// The small triangle kernels on vectors, written once for Highway, which compiles this file anew for each instruction
// set: a lane for each triangle where they are offered, for each pixel where texels are found.
#include "raster/instruction_sets.h"
#include "raster/pixel_bounds.h"
#include "raster/small_triangle_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "raster/small_triangle_kernels_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

/// Vectors of as many values each.
using Doubles = hn::CappedTag<double, mostVertexLanes>;
using Floats = hn::Rebind<float, Doubles>;
using Integers = hn::Rebind<std::int32_t, Doubles>;
using Numbers = hn::Rebind<std::uint32_t, Doubles>;
using Bytes = hn::Rebind<std::uint8_t, Doubles>;
using Double = hn::Vec<Doubles>;
using Float = hn::Vec<Floats>;
using Integer = hn::Vec<Integers>;

constexpr Doubles doubles;
constexpr Floats floats;
constexpr Integers integers;

Double all(double value) { return hn::Set(doubles, value); }
Float all(float value) { return hn::Set(floats, value); }
Integer all(std::int32_t value) { return hn::Set(integers, value); }

template <typename Tag>
std::uint32_t bitsOf(Tag tag, hn::Mask<Tag> mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(tag, mask, bits);
  return bits[0];
}

hn::Mask<Integers> maskOf(std::uint32_t bits) {
  const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
  return hn::LoadMaskBits(integers, bytes);
}

/// Of three corners.
template <typename Value>
struct Corners {
  Value a, b, c;
};

/// Pixels of [first, first + count) whose samples lie between the least and the largest snapped value; none in lanes
/// without a triangle.
struct Samples {
  Integer first, count;

  Samples(const Corners<Integer>& at, int scissorFirst, int scissorCount, hn::Mask<Integers> there) {
    const Integer least = hn::Min(hn::Min(at.a, at.b), at.c), largest = hn::Max(hn::Max(at.a, at.b), at.c);
    first = hn::Max(hn::ShiftRight<8>(hn::Add(least, all(127))), all(scissorFirst));
    const Integer end = hn::Min(hn::ShiftRight<8>(hn::Add(largest, all(128))), all(scissorFirst + scissorCount));
    count = hn::IfThenElseZero(there, hn::Sub(end, first));
  }
};

/// Positions less that of the first sample.
Corners<Float> fromSample(const Corners<Integer>& at, Integer first) {
  const Integer sample = hn::Add(hn::ShiftLeft<8>(first), all(128));
  const auto from = [&](Integer position) { return hn::ConvertTo(floats, hn::Sub(position, sample)); };
  return {from(at.a), from(at.b), from(at.c)};
}

Float cross(Float ax, Float ay, Float bx, Float by) { return hn::Sub(hn::Mul(ax, by), hn::Mul(bx, ay)); }

/// Edges, as SmallEdge in small_triangle_kernels.cpp.
struct SmallEdges {
  Float a, b, c, least;

  SmallEdges() = default;
  SmallEdges(Float px, Float py, Float qx, Float qy, Float orientation) {
    const Float zero = hn::Zero(floats), scale = hn::Mul(orientation, all(256.0F));
    a = hn::Mul(scale, hn::Sub(py, qy));
    b = hn::Mul(scale, hn::Sub(qx, px));
    c = hn::Mul(orientation, cross(px, py, qx, qy));
    const auto isTop = hn::And(hn::Eq(a, zero), hn::Gt(b, zero));
    least = hn::IfThenZeroElse(hn::Or(hn::Gt(a, zero), isTop), all(1.0F));
  }

  Float at(int i, int j) const {
    return hn::Add(hn::Add(c, hn::Mul(a, all(static_cast<float>(i)))), hn::Mul(b, all(static_cast<float>(j))));
  }
};

Double dot(const Corners<Double>& a, const Corners<Double>& b) {
  return hn::Add(hn::Add(hn::Mul(a.a, b.a), hn::Mul(a.b, b.b)), hn::Mul(a.c, b.c));
}

Corners<Double> promoted(const Corners<Float>& of) {
  return {hn::PromoteTo(doubles, of.a), hn::PromoteTo(doubles, of.b), hn::PromoteTo(doubles, of.c)};
}

/// Triangles side by side, from the `from`th of a part on.
class Group {
 public:
  Group(const OfferedTriangles& triangles, std::uint32_t from, hn::Mask<Integers> there, const DepthBuffer& buffer)
      : Group(triangles, corners(triangles, from), there, buffer) {
    firstNumber_ = triangles.firstNumber + from;
  }

  bool offer(DepthBuffer& buffer, UndecidedSamples& undecided) const {
    bool isTaken = false;
    const auto reach = [](Integer count, int i) { return hn::Gt(count, all(i)); };
    for (int j = 0; !hn::AllFalse(integers, reach(rows_.count, j)); ++j)
      for (int i = 0;; ++i) {
        const auto inside = hn::And(reach(rows_.count, j), reach(columns_.count, i));
        if (hn::AllFalse(integers, inside)) break;
        isTaken = offerSamples(i, j, hn::RebindMask(floats, inside), buffer, undecided) || isTaken;
      }
    return isTaken;
  }

 private:
  static Corners<Integer> corners(const OfferedTriangles& triangles, std::uint32_t from) {
    const auto load = [&](std::size_t k) {
      return hn::PromoteTo(integers,
                           hn::LoadU(Bytes(), triangles.mesh.corners[k].data() + triangles.part.firstTriangle + from));
    };
    return {load(0), load(1), load(2)};
  }

  template <typename Tag, typename Value>
  static Corners<hn::Vec<Tag>> gathered(Tag tag, const Value* values, const Corners<Integer>& at) {
    return {hn::GatherIndex(tag, values, at.a), hn::GatherIndex(tag, values, at.b), hn::GatherIndex(tag, values, at.c)};
  }

  Group(const OfferedTriangles& triangles, const Corners<Integer>& at, hn::Mask<Integers> there,
        const DepthBuffer& buffer)
      : Group(gathered(integers, triangles.placed.across.data(), at),
              gathered(integers, triangles.placed.down.data(), at), gathered(floats, triangles.placed.w.data(), at),
              there, buffer) {}

  Group(const Corners<Integer>& across, const Corners<Integer>& down, const Corners<Float>& w, hn::Mask<Integers> there,
        const DepthBuffer& buffer)
      : columns_(across, buffer.scissor.column, buffer.scissor.width, there),
        rows_(down, buffer.scissor.row, buffer.scissor.height, there) {
    const Corners<Float> x = fromSample(across, columns_.first), y = fromSample(down, rows_.first);
    const Float area = cross(hn::Sub(x.b, x.a), hn::Sub(y.b, y.a), hn::Sub(x.c, x.a), hn::Sub(y.c, y.a));
    rows_.count = hn::IfThenZeroElse(hn::RebindMask(integers, hn::Eq(area, hn::Zero(floats))), rows_.count);
    const Float orientation = hn::IfThenElse(hn::Gt(area, hn::Zero(floats)), all(1.0F), all(-1.0F));
    edges_[0] = SmallEdges(x.b, y.b, x.c, y.c, orientation);
    edges_[1] = SmallEdges(x.c, y.c, x.a, y.a, orientation);
    edges_[2] = SmallEdges(x.a, y.a, x.b, y.b, orientation);
    const Corners<Double> depth = promoted(w);
    const Double product = hn::Mul(hn::Mul(depth.a, depth.b), depth.c);
    const Double scale = hn::Div(all(1.0), hn::Mul(product, hn::PromoteTo(doubles, hn::Abs(area))));
    weights_ = {hn::Mul(hn::Mul(depth.b, depth.c), scale), hn::Mul(hn::Mul(depth.c, depth.a), scale),
                hn::Mul(hn::Mul(depth.a, depth.b), scale)};
  }

  /// The samples i columns and j rows from the first.
  bool offerSamples(int i, int j, hn::Mask<Floats> inside, DepthBuffer& buffer, UndecidedSamples& undecided) const {
    const Corners<Float> e{edges_[0].at(i, j), edges_[1].at(i, j), edges_[2].at(i, j)};
    const auto covered = hn::And(hn::And(inside, hn::Ge(e.a, edges_[0].least)),
                                 hn::And(hn::Ge(e.b, edges_[1].least), hn::Ge(e.c, edges_[2].least)));
    if (hn::AllFalse(floats, covered)) return false;
    HWY_ALIGN double inverseDepths[mostVertexLanes];
    HWY_ALIGN std::int32_t columns[mostVertexLanes], rows[mostVertexLanes];
    hn::Store(dot(promoted(e), weights_), doubles, inverseDepths);
    hn::Store(hn::Add(columns_.first, all(i)), integers, columns);
    hn::Store(hn::Add(rows_.first, all(j)), integers, rows);
    bool isTaken = false;
    for (std::uint32_t left = bitsOf(floats, covered); left != 0; left &= left - 1) {
      const auto lane = static_cast<std::uint32_t>(__builtin_ctz(left));
      const std::uint32_t number = firstNumber_ + lane;
      const DepthTest test = testDepth(inverseDepths[lane], number, buffer.pixelAt(columns[lane], rows[lane]), buffer);
      isTaken = isTaken || test == DepthTest::Taken;
      if (test == DepthTest::Undecided) undecided.add(number, columns[lane], rows[lane]);
    }
    return isTaken;
  }

  Samples columns_, rows_;
  SmallEdges edges_[3];
  Corners<Double> weights_;
  std::uint32_t firstNumber_ = 0;
};

bool offer(const OfferedTriangles& triangles, DepthBuffer& buffer, UndecidedSamples& undecided) {
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(integers));
  bool isTaken = false;
  for (std::uint32_t from = 0; from < triangles.part.triangles; from += lanes) {
    const std::uint32_t bits = triangles.set >> from & ((1U << lanes) - 1);
    if (bits != 0) isTaken = Group(triangles, from, maskOf(bits), buffer).offer(buffer, undecided) || isTaken;
  }
  return isTaken;
}

/// A texture coordinate, as SmallTexel in small_triangle_kernels.cpp.
struct SmallTexel {
  Double texel;
  hn::Mask<Doubles> isClear;

  SmallTexel(const Corners<Double>& weights, Double inverseSum, const Corners<Double>& coordinate, Double size) {
    const Double position = hn::Mul(hn::Mul(dot(weights, coordinate), inverseSum), size);
    const Double largest =
        hn::Mul(hn::Max(hn::Max(hn::Abs(coordinate.a), hn::Abs(coordinate.b)), hn::Abs(coordinate.c)), size);
    const Double whole = hn::Floor(position), clear = hn::Sub(all(0.5), hn::Mul(all(depthError), largest));
    const Double offCentre = hn::Abs(hn::Sub(hn::Sub(position, whole), all(0.5)));
    isClear = hn::Or(hn::Lt(offCentre, clear), hn::Eq(size, all(1.0)));
    texel = hn::Max(hn::Min(whole, hn::Sub(size, all(1.0))), hn::Zero(doubles));
  }
};

SmallTexels findTexels(const SmallPixels& pixels, std::size_t count) {
  const std::size_t lanes = hn::Lanes(doubles);
  SmallTexels found;
  for (std::size_t i = 0; i < count; i += lanes) {
    const auto load = [i](const SmallPixels::Values& values) { return hn::LoadU(floats, values.data() + i); };
    const auto corners = [&](const std::array<SmallPixels::Values, 3>& values) {
      return Corners<Float>{load(values[0]), load(values[1]), load(values[2])};
    };
    const Corners<Float> x = corners(pixels.across), y = corners(pixels.down);
    const Corners<Double> w = promoted(corners(pixels.w));
    const Corners<Double> e =
        promoted({cross(x.b, y.b, x.c, y.c), cross(x.c, y.c, x.a, y.a), cross(x.a, y.a, x.b, y.b)});
    const Corners<Double> weights{hn::Mul(e.a, hn::Mul(w.b, w.c)), hn::Mul(e.b, hn::Mul(w.c, w.a)),
                                  hn::Mul(e.c, hn::Mul(w.a, w.b))};
    const Double sum = hn::Add(hn::Add(weights.a, weights.b), weights.c), inverseSum = hn::Div(all(1.0), sum);
    const Double columns = hn::LoadU(doubles, pixels.columns.data() + i);
    const Double rows = hn::LoadU(doubles, pixels.rows.data() + i);
    const SmallTexel column(weights, inverseSum, promoted(corners(pixels.u)), columns);
    const SmallTexel row(weights, inverseSum, promoted(corners(pixels.v)), rows);
    const Double texel = hn::Add(hn::Mul(row.texel, columns), column.texel);
    hn::StoreU(hn::BitCast(Numbers(), hn::DemoteTo(integers, texel)), Numbers(), found.texels.data() + i);
    found.decided |= bitsOf(doubles, hn::And(column.isClear, row.isClear)) << i;
    found.negative |= bitsOf(doubles, hn::Lt(sum, hn::Zero(doubles))) << i;
  }
  return found;
}

SmallTriangleKernels smallTriangleKernels() { return {hwy::TargetName(HWY_TARGET), offer, findTexels}; }

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace hemitex::raster {
namespace {

HWY_EXPORT(smallTriangleKernels);

std::vector<SmallTriangleKernels> allKernels() {
  std::vector<SmallTriangleKernels> all;
  forEveryInstructionSet([&all] { all.push_back(HWY_DYNAMIC_DISPATCH(smallTriangleKernels)()); });
  return all;
}

}  // namespace

const std::vector<SmallTriangleKernels>& simdSmallTriangleKernels() {
  static const std::vector<SmallTriangleKernels> all = allKernels();
  return all;
}

}  // namespace hemitex::raster
#endif
