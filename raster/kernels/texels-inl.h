/// Kernels for the texels of runs of pixels that show one triangle. Lanes hold adjacent pixels.
// No include guard: kernels.cpp includes this file once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE::texels {
namespace {

template <typename Action>
void forEachLane(const Mask mask, const Action& action) {
  HWY_ALIGN std::uint8_t bits[8] = {};
  hn::StoreMaskBits(doubles, mask, bits);
  for (unsigned left = bits[0]; left != 0; left &= left - 1) action(__builtin_ctz(left));
}

/// A texture coordinate along a row.
struct Texels {
  Double at, right, last, middle;

  Texels(const TexelPlane& plane, double row)
      : at(hn::Set(doubles, plane.at + plane.down * row)),
        right(hn::Set(doubles, plane.right)),
        last(hn::Set(doubles, plane.last)),
        middle(hn::Set(doubles, plane.middle)) {}

  /// Returns the texels of pixels, and the distance of each position from the middle between two borders.
  Double find(Double column, Double w, Double& offCentre) const {
    const Double position = hn::Mul(hn::Add(at, hn::Mul(right, column)), w);
    const Double texel = hn::Floor(position);
    offCentre = hn::Abs(hn::Sub(hn::Sub(position, texel), middle));
    return hn::Max(hn::Min(texel, last), hn::Zero(doubles));
  }
};

/// Stores `base` plus the numbers of adjacent texels of a map with this number of columns.
void storeTexels(Double column, Double row, Double columns, std::uint32_t base, std::uint32_t* texels) {
  const auto texel = hn::BitCast(Numbers(), hn::DemoteTo(Integers(), hn::Add(hn::Mul(row, columns), column)));
  hn::StoreU(hn::Add(texel, hn::Set(Numbers(), base)), Numbers(), texels);
}

/// The constants of a run in double precision.
struct RunInBinary64 {
  Texels u, v;
  Double width, end, clear, error;

  RunInBinary64(const PixelRun& run, const TexelPlanes& planes)
      : u(planes.u, run.row),
        v(planes.v, run.row),
        width(hn::Set(doubles, planes.u.last + 1)),
        end(hn::Set(doubles, static_cast<double>(run.firstColumn + run.count))),
        clear(hn::Set(doubles, 0.5 - planes.rounding)),
        error(hn::Set(doubles, planes.error)) {}

  /// Stores the texels of adjacent columns; returns the unresolved lanes.
  Mask find(Double columns, const double* inverseDepth, std::uint32_t base, std::uint32_t* texels) const {
    const Double w = hn::Div(hn::Set(doubles, 1.0), hn::LoadU(doubles, inverseDepth));
    Double offAcross, offDown;
    const Double column = u.find(columns, w, offAcross), row = v.find(columns, w, offDown);
    storeTexels(column, row, width, base, texels);
    const Double limit = hn::Sub(clear, hn::Mul(error, w));
    const Mask decided = hn::And(hn::Lt(offAcross, limit), hn::Lt(offDown, limit));
    return hn::AndNot(decided, hn::Lt(columns, end));
  }
};

Double columnsFrom(int column) { return hn::Add(hn::Set(doubles, static_cast<double>(column)), hn::Iota(doubles, 0)); }

/// Lists the unresolved pixels of a run. Not inline, because a call inside the loop would spill registers.
HWY_NOINLINE void listUnresolvedTexels(const PixelRun& run, const TexelPlanes& planes, UnresolvedPixels& unresolved) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  const RunInBinary64 line(run, planes);
  std::uint32_t texels[maxLanes];
  for (int i = 0; i < run.count; i += lanes)
    forEachLane(line.find(columnsFrom(run.firstColumn + i), run.inverseDepth + i, 0, texels),
                [&](int lane) { unresolved.add(run.firstColumn + i + lane, run.row); });
}

void findTexelsInBinary64(const PixelRun& run, const TexelPlanes& planes, std::uint32_t base, std::uint32_t* texels,
                          UnresolvedPixels& unresolved) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  const Double stride = hn::Set(doubles, static_cast<double>(lanes));
  const RunInBinary64 line(run, planes);
  Double columns = columnsFrom(run.firstColumn);
  Mask lanesLeft = firstLanes(0);
  for (int i = 0; i < run.count; i += lanes, columns = hn::Add(columns, stride))
    lanesLeft = hn::Or(lanesLeft, line.find(columns, run.inverseDepth + i, base, texels + i));
  if (!hn::AllFalse(doubles, lanesLeft)) listUnresolvedTexels(run, planes, unresolved);
}

using WideFloats = hn::CappedTag<float, maxLanes>;
using WideFloat = hn::Vec<WideFloats>;
using TexelNumbers = hn::Rebind<std::uint32_t, WideFloats>;

constexpr WideFloats wideFloats;

/// A texture coordinate along a run, relative to a texel border near the pixel in the middle of the run, so that values
/// are small. It is (at + i * step) / (1 + i * depthStep) at the i-th pixel from the middle.
struct LineInBinary32 {
  double border, at, step;

  LineInBinary32(const TexelPlane& plane, int column, int row, double w, double depthStep) {
    const double position = ((plane.at + plane.down * row) + plane.right * column) * w;
    border = std::floor(position);
    at = position - border;
    step = plane.right * w - border * depthStep;
  }
};

/// A run in binary32, which has twice as many lanes as binary64 and resolves nearly all texels. A resolved position is
/// farther from borders than both error bounds.
///
/// 1/w differs from its value in the middle by at most a factor of two. Let m = 1 + half the count * |step|. Values up
/// to m have thirteen roundings up to the quotient, which is at most twice as large. That gives 26 m units of 2^-24.
/// For the same reason the binary64 error of the coefficients in the middle counts twice. The border times the error of
/// 1/w, four units of depthError, counts twice as well.
///
/// Binary32 represents integers up to 2^24. Texel numbers stay below half of that. A border may be larger; then all
/// nearby positions lie on one side of the map.
struct RunInBinary32 {
  int middle = 0;
  double depthStep = 0;
  LineInBinary32 u, v;
  double clear;  ///< see Texels::find; 1/4 or less if binary32 is not accurate enough

  RunInBinary32(const PixelRun& run, const TexelPlanes& planes, int inMiddle, double w)
      : middle(inMiddle),
        depthStep((run.inverseDepth[run.count - 1] - run.inverseDepth[0]) * w / (run.count - 1)),
        u(planes.u, run.firstColumn + middle, run.row, w, depthStep),
        v(planes.v, run.firstColumn + middle, run.row, w, depthStep) {
    const int half = run.count - middle;
    const double change = std::abs(depthStep) * half;
    const double size = 2 + half * std::max(std::abs(u.step), std::abs(v.step));
    const double borders = 1 + std::abs(u.border) + std::abs(v.border);
    clear = 0.5 - 26 * 0x1p-24 * size - 2 * (planes.error * w + planes.rounding) - 8 * depthError * borders;
    const double texels = (planes.u.last + 1) * (planes.v.last + 1);
    if (!(change <= 0.5 && texels <= 0x1p23)) clear = 0;
  }
};

/// A texture coordinate along a run. With or without fused multiply-add, the error is within the rounding that `clear`
/// allows.
struct TexelsInBinary32 {
  WideFloat at, step, middle, border, last;

  TexelsInBinary32(const LineInBinary32& line, const TexelPlane& plane)
      : at(hn::Set(wideFloats, static_cast<float>(line.at))),
        step(hn::Set(wideFloats, static_cast<float>(line.step))),
        middle(hn::Set(wideFloats, static_cast<float>(plane.middle))),
        border(hn::Set(wideFloats, static_cast<float>(line.border))),
        last(hn::Set(wideFloats, static_cast<float>(plane.last))) {}

  /// Returns the texels of pixels, and the distance of each position from the middle between two borders.
  WideFloat find(WideFloat pixel, WideFloat w, WideFloat& offCentre) const {
    const WideFloat position = hn::Mul(hn::MulAdd(step, pixel, at), w);
    const WideFloat texel = hn::Floor(position);
    offCentre = hn::Abs(hn::Sub(hn::Sub(position, texel), middle));
    return hn::Max(hn::Min(hn::Add(texel, border), last), hn::Zero(wideFloats));
  }
};

/// Marks a texel that binary32 does not resolve. A resolved texel may have the same number; then it is only computed
/// twice.
constexpr std::uint32_t unresolvedTexel = 0xffffffff;

/// The constants of a run in binary32, as vectors.
struct WalkInBinary32 {
  TexelsInBinary32 u, v;
  WideFloat depthStep, clear, width, end;
  // Binary32 numbers from 2^23 on are consecutive integers, so that 2^23 + n has the bits of 2^23 plus n.
  WideFloat counting = hn::Set(wideFloats, 0x1p23F);
  hn::Vec<TexelNumbers> offset;

  WalkInBinary32(const PixelRun& run, const RunInBinary32& line, const TexelPlanes& planes, std::uint32_t base)
      : u(line.u, planes.u),
        v(line.v, planes.v),
        depthStep(hn::Set(wideFloats, static_cast<float>(line.depthStep))),
        clear(hn::Set(wideFloats, static_cast<float>(line.clear))),
        width(hn::Set(wideFloats, static_cast<float>(planes.u.last + 1))),
        end(hn::Set(wideFloats, static_cast<float>(run.count - line.middle))),
        offset(hn::Sub(hn::Set(TexelNumbers(), base), hn::BitCast(TexelNumbers(), counting))) {}

  /// Stores the texels of adjacent pixels, unresolvedTexel for unresolved ones; returns the unresolved lanes.
  hn::Mask<WideFloats> find(WideFloat pixel, std::uint32_t* texels) const {
    const WideFloat one = hn::Set(wideFloats, 1.0F);
    const WideFloat w = hn::Div(one, hn::MulAdd(depthStep, pixel, one));
    WideFloat offAcross, offDown;
    const WideFloat column = u.find(pixel, w, offAcross), row = v.find(pixel, w, offDown);
    const WideFloat texel = hn::Add(hn::MulAdd(row, width, column), counting);
    const auto unresolved = hn::AndNot(hn::Lt(hn::Max(offAcross, offDown), clear), hn::Lt(pixel, end));
    const auto told = hn::Add(hn::BitCast(TexelNumbers(), texel), offset);
    hn::StoreU(
        hn::IfThenElse(hn::RebindMask(TexelNumbers(), unresolved), hn::Set(TexelNumbers(), unresolvedTexel), told),
        TexelNumbers(), texels);
    return unresolved;
  }
};

/// Computes the texels that binary32 left unresolved in double precision.
HWY_NOINLINE void findUnresolvedTexels(const PixelRun& run, const TexelPlanes& planes, std::uint32_t base,
                                       std::uint32_t* texels, UnresolvedPixels& unresolved) {
  const auto lanes = static_cast<int>(hn::Lanes(wideFloats));
  for (int i = 0; i < run.count; i += lanes) {
    const auto isOpen = hn::Eq(hn::LoadU(TexelNumbers(), texels + i), hn::Set(TexelNumbers(), unresolvedTexel));
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(TexelNumbers(), isOpen, bits);
    for (unsigned left = bits[0] + 256U * bits[1]; left != 0; left &= left - 1) {
      const int at = i + __builtin_ctz(left);
      if (at >= run.count) return;
      const PixelRun alone{run.triangle, run.row, run.firstColumn + at, 1, run.inverseDepth + at};
      std::uint32_t found[maxLanes];
      findTexelsInBinary64(alone, planes, base, found, unresolved);
      texels[at] = found[0];
    }
  }
}

void findTexels(const PixelRun& run, const TexelPlanes& planes, std::uint32_t base, std::uint32_t* texels,
                UnresolvedPixels& unresolved) {
  constexpr int shortest = 16;  // shorter runs are faster in double precision
  if (run.count < shortest) return findTexelsInBinary64(run, planes, base, texels, unresolved);
  const int middle = run.count / 2;
  const RunInBinary32 line(run, planes, middle, 1 / run.inverseDepth[middle]);
  if (!(line.clear > 0.25)) return findTexelsInBinary64(run, planes, base, texels, unresolved);
  const WalkInBinary32 walk(run, line, planes, base);
  const auto lanes = static_cast<int>(hn::Lanes(wideFloats));
  const WideFloat stride = hn::Set(wideFloats, static_cast<float>(lanes));
  WideFloat pixel = hn::Sub(hn::Iota(wideFloats, 0), hn::Set(wideFloats, static_cast<float>(middle)));
  auto lanesLeft = hn::FirstN(wideFloats, 0);
  for (int i = 0; i < run.count; i += lanes, pixel = hn::Add(pixel, stride))
    lanesLeft = hn::Or(lanesLeft, walk.find(pixel, texels + i));
  if (!hn::AllFalse(wideFloats, lanesLeft)) findUnresolvedTexels(run, planes, base, texels, unresolved);
}

/// The texels of pixels i along a line of exact quotients.
Double findExactly(const ExactLine& line, Double i, int size) {
  const auto along = [i](double at, double step) {
    return hn::Add(hn::Set(doubles, at), hn::Mul(hn::Set(doubles, step), i));
  };
  const Double position = hn::Div(along(line.at, line.step), along(line.below, line.belowStep));
  return hn::Floor(hn::Max(hn::Min(position, hn::Set(doubles, size - 1.0)), hn::Set(doubles, 0.0)));
}

void findExactTexels(const PixelRun& run, const ExactTexels& exact, int width, int height, std::uint32_t base,
                     std::uint32_t* texels) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  const ExactLine u(run, exact.u), v(run, exact.v);
  const Double columns = hn::Set(doubles, static_cast<double>(width));
  Double pixels = hn::Iota(doubles, 0);
  for (int i = 0; i < run.count; i += lanes, pixels = hn::Add(pixels, hn::Set(doubles, static_cast<double>(lanes))))
    storeTexels(findExactly(u, pixels, width), findExactly(v, pixels, height), columns, base, texels + i);
}

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE::texels
HWY_AFTER_NAMESPACE();
