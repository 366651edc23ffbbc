/// Kernels for small triangles (small_triangles.h). Lanes hold triangles during setup, then samples.
// No include guard: kernels.cpp includes this file once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE::small {
namespace {

/// One vector per corner.
template <typename Value>
struct Corners {
  Value a, b, c;
};

template <typename Tag, typename Value>
Corners<hn::Vec<Tag>> gathered(Tag tag, const Value* values, const Corners<Integer>& at) {
  return {hn::GatherIndex(tag, values, at.a), hn::GatherIndex(tag, values, at.b), hn::GatherIndex(tag, values, at.c)};
}

template <typename From>
Corners<Double> promoted(const Corners<From>& of) {
  return {hn::PromoteTo(doubles, of.a), hn::PromoteTo(doubles, of.b), hn::PromoteTo(doubles, of.c)};
}

Double sum(const Corners<Double>& of) { return hn::Add(hn::Add(of.a, of.b), of.c); }

Corners<Double> product(const Corners<Double>& a, const Corners<Double>& b) {
  return {hn::Mul(a.a, b.a), hn::Mul(a.b, b.b), hn::Mul(a.c, b.c)};
}

Double largestOf(const Corners<Double>& of) { return hn::Max(hn::Max(of.a, of.b), of.c); }

Corners<Double> absolute(const Corners<Double>& of) { return {hn::Abs(of.a), hn::Abs(of.b), hn::Abs(of.c)}; }

/// Exchanges the corners b and c in the lanes of a mask.
template <typename Value, typename Mask>
void swap(Mask mask, Corners<Value>& of) {
  const Value b = of.b;
  of.b = hn::IfThenElse(mask, of.c, of.b);
  of.c = hn::IfThenElse(mask, b, of.c);
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

/// The edge from p to q of triangles of positive area.
struct SmallEdge {
  Integer at, right, down, least;

  SmallEdge(Integer px, Integer py, Integer qx, Integer qy)
      : at(cross(px, py, qx, qy)),
        right(hn::ShiftLeft<8>(hn::Sub(py, qy))),
        down(hn::ShiftLeft<8>(hn::Sub(qx, px))),
        least(hn::IfThenZeroElse(hn::Or(hn::Gt(py, qy), hn::And(hn::Eq(py, qy), hn::Gt(qx, px))), all(1))) {}
};

/// A texture coordinate at the corners, in texels. If all corners, and so all samples, have the same
/// texel, its middle stands for all positions.
struct Texels {
  Corners<Double> position;
  Double texel;
  hn::Mask<Doubles> isUniform;

  Texels(const Corners<Double>& coordinate, int size)
      : position(product(coordinate, {all(1.0 * size), all(1.0 * size), all(1.0 * size)})) {
    const auto texelAt = [size](Double at) {
      return hn::Max(hn::Min(hn::Floor(at), all(size - 1.0)), hn::Zero(doubles));
    };
    texel = texelAt(position.a);
    isUniform = hn::And(hn::Eq(texel, texelAt(position.b)), hn::Eq(texel, texelAt(position.c)));
    const Double middle = hn::Add(texel, all(0.5));
    position.a = hn::IfThenElse(isUniform, middle, position.a);
    position.b = hn::IfThenElse(isUniform, middle, position.b);
    position.c = hn::IfThenElse(isUniform, middle, position.c);
  }
};

struct Weights {
  Corners<Double> at, right, down;
};

void store(Double at, Double right, Double down, std::uint32_t from, SmallPlanes& planes) {
  hn::StoreU(at, doubles, planes.at.data() + from);
  hn::StoreU(right, doubles, planes.right.data() + from);
  hn::StoreU(down, doubles, planes.down.data() + from);
}

void storePlane(const Weights& weights, const Corners<Double>& values, std::uint32_t from, SmallPlanes& planes) {
  store(sum(product(weights.at, values)), sum(product(weights.right, values)), sum(product(weights.down, values)), from,
        planes);
}

void store(Integer values, std::uint32_t from, EachSmall<std::int32_t>& to) {
  hn::StoreU(values, integers, to.data() + from);
}

/// The corners of all triangles of a part as integers, because bytes cannot be gathered.
struct PartCorners {
  HWY_ALIGN std::int32_t corners[3][largestCluster];

  explicit PartCorners(const SmallTriangles& triangles) {
    for (std::size_t k = 0; k < 3; ++k)
      for (std::size_t t = 0; t < triangles.part.triangles; t += hn::Lanes(integers)) {
        const auto bytes = hn::LoadU(Bytes(), triangles.mesh.corners[k].data() + triangles.part.firstTriangle + t);
        hn::Store(hn::PromoteTo(integers, bytes), integers, corners[k] + t);
      }
  }
  Corners<Integer> from(std::uint32_t t) const {
    return {hn::Load(integers, corners[0] + t), hn::Load(integers, corners[1] + t), hn::Load(integers, corners[2] + t)};
  }
  Corners<Integer> of(Integer triangles) const {
    return {hn::GatherIndex(integers, corners[0], triangles), hn::GatherIndex(integers, corners[1], triangles),
            hn::GatherIndex(integers, corners[2], triangles)};
  }
};

/// The bounds and edges of triangles, one triangle per lane.
struct Outlines {
  Samples columns, rows;
  Integer area;
  hn::Mask<Integers> isNegative;
  Corners<Integer> x, y;  ///< from the first sample of the bounds, with b and c exchanged in negative triangles

  HWY_INLINE Outlines(const SmallTriangles& triangles, const Corners<Integer>& at, const Scissor& part)
      : Outlines(gathered(integers, triangles.placed.x.data(), at), gathered(integers, triangles.placed.y.data(), at),
                 part) {}

  HWY_INLINE Outlines(const Corners<Integer>& across, const Corners<Integer>& down, const Scissor& part)
      : columns(across, part.column, part.width),
        rows(down, part.row, part.height),
        x(fromSample(across, columns.first)),
        y(fromSample(down, rows.first)) {
    area = cross(hn::Sub(x.b, x.a), hn::Sub(y.b, y.a), hn::Sub(x.c, x.a), hn::Sub(y.c, y.a));
    isNegative = hn::Lt(area, hn::Zero(integers));
    swap(isNegative, x);
    swap(isNegative, y);
  }
  HWY_INLINE Corners<SmallEdge> edges() const {
    return {{x.b, y.b, x.c, y.c}, {x.c, y.c, x.a, y.a}, {x.a, y.a, x.b, y.b}};
  }
};

/// Negative where the edge does not cover one of the samples that are 0 or 1 columns and rows from the first.
struct TwoByTwo {
  Integer samples[2][2];

  explicit TwoByTwo(const SmallEdge& edge) {
    samples[0][0] = hn::Sub(edge.at, edge.least);
    samples[0][1] = hn::Add(samples[0][0], edge.right);
    samples[1][0] = hn::Add(samples[0][0], edge.down);
    samples[1][1] = hn::Add(samples[1][0], edge.right);
  }
};

/// The triangles from number `from` on that cover one of the first two samples in the first two rows of their bounds,
/// one bit each.
std::uint32_t coverAny(const SmallTriangles& triangles, const PartCorners& corners, std::uint32_t from,
                       const Scissor& part) {
  const Corners<SmallEdge> edges = Outlines(triangles, corners.from(from), part).edges();
  const TwoByTwo a(edges.a), b(edges.b), c(edges.c);
  Integer outside = all(-1);
  for (int j = 0; j < 2; ++j)
    for (int i = 0; i < 2; ++i)
      outside = hn::And(outside, hn::Or(hn::Or(a.samples[j][i], b.samples[j][i]), c.samples[j][i]));
  return bitsOf(integers, hn::Gt(outside, all(-1)));
}

/// Sets up entries of the setup from the `k`th on.
void setUpEntries(const SmallTriangles& triangles, const PartCorners& corners, std::uint32_t k, const Scissor& part,
                  SmallSetup& setup) {
  const Corners<Integer> at = corners.of(hn::LoadU(integers, setup.triangles.data() + k));
  const Outlines outlines(triangles, at, part);
  Corners<Double> w = promoted(gathered(floats, triangles.placed.w.data(), at));
  const float* const texcoords = &triangles.mesh.texcoords[triangles.part.firstVertex].x;
  const Corners<Integer> pair{hn::Add(at.a, at.a), hn::Add(at.b, at.b), hn::Add(at.c, at.c)};
  Corners<Double> u = promoted(gathered(floats, texcoords, pair));
  Corners<Double> v = promoted(gathered(floats, texcoords + 1, pair));
  const Double area = hn::PromoteTo(doubles, outlines.area);
  const auto isReversed = hn::Lt(area, hn::Zero(doubles));
  swap(isReversed, w);
  swap(isReversed, u);
  swap(isReversed, v);

  const auto [a, b, c] = outlines.edges();
  const Corners<Double> edge = promoted(Corners<Integer>{a.at, b.at, c.at});
  const Corners<Double> right = promoted(Corners<Integer>{a.right, b.right, c.right});
  const Corners<Double> down = promoted(Corners<Integer>{a.down, b.down, c.down});
  const Corners<Double> least = promoted(Corners<Integer>{a.least, b.least, c.least});
  const Double inverse = hn::Div(all(1.0), hn::Mul(hn::Mul(hn::Mul(w.a, w.b), w.c), hn::Abs(area)));
  const Corners<Double> depths{hn::Mul(inverse, hn::Mul(w.b, w.c)), hn::Mul(inverse, hn::Mul(w.c, w.a)),
                               hn::Mul(inverse, hn::Mul(w.a, w.b))};
  const Double lastColumn = hn::PromoteTo(doubles, hn::Sub(outlines.columns.count, all(1)));
  const Double lastRow = hn::PromoteTo(doubles, hn::Sub(outlines.rows.count, all(1)));
  const auto most = [&](Double atFirst, Double toRight, Double toBelow) {
    return hn::Add(hn::Add(hn::Abs(atFirst), hn::Mul(hn::Abs(toRight), lastColumn)),
                   hn::Mul(hn::Abs(toBelow), lastRow));
  };
  const Corners<Double> terms{most(edge.a, right.a, down.a), most(edge.b, right.b, down.b),
                              most(edge.c, right.c, down.c)};
  const Double error = hn::Mul(all(16 * unitRoundoff), hn::Mul(sum(product(terms, depths)), largestOf(w)));
  const auto isExact = hn::Lt(error, all(depthError));
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(integers));
  const std::uint32_t there = (1U << std::min(lanes, setup.count - k)) - 1;
  const std::uint32_t flat = bitsOf(integers, hn::Eq(outlines.area, hn::Zero(integers)));
  setup.thin |= (there & ~flat & ~bitsOf(doubles, isExact)) << k;
  setup.negative |= (there & bitsOf(integers, outlines.isNegative)) << k;

  store(outlines.columns.first, k, setup.firstColumn);
  store(outlines.columns.count, k, setup.columns);
  store(outlines.rows.first, k, setup.firstRow);
  store(hn::DemoteTo(integers, hn::IfThenElseZero(isExact, hn::Add(lastRow, all(1.0)))), k, setup.rows);
  store(hn::Sub(edge.a, least.a), right.a, down.a, k, setup.edges[0]);
  store(hn::Sub(edge.b, least.b), right.b, down.b, k, setup.edges[1]);
  store(hn::Sub(edge.c, least.c), right.c, down.c, k, setup.edges[2]);
  const Weights weights{product(edge, depths), product(right, depths), product(down, depths)};
  storePlane(weights, {all(1.0), all(1.0), all(1.0)}, k, setup.inverseDepth);
  const Texels column(u, triangles.columns), row(v, triangles.rows);
  storePlane(weights, column.position, k, setup.column);
  storePlane(weights, row.position, k, setup.row);
  const Double largest = hn::Max(largestOf(absolute(column.position)), largestOf(absolute(row.position)));
  hn::StoreU(hn::Sub(all(0.5), hn::Mul(all(3 * depthError), largest)), doubles, setup.clear.data() + k);
  setup.uniform |= (there & bitsOf(doubles, hn::And(column.isUniform, row.isUniform))) << k;
  const Double texel = hn::Add(hn::Mul(row.texel, all(1.0 * triangles.columns)), column.texel);
  store(hn::DemoteTo(integers, texel), k, setup.texel);
}

/// Lists the triangles that may cover a sample.
void listTriangles(const SmallTriangles& triangles, const PartCorners& corners, const Scissor& part,
                   SmallSetup& setup) {
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(integers));
  setup.count = 0;
  for (std::uint32_t from = 0; from < triangles.part.triangles; from += lanes) {
    std::uint32_t set = triangles.set >> from & ((1U << lanes) - 1);
    const std::uint32_t tiny = triangles.tiny >> from & set;
    if (tiny != 0) set &= ~tiny | coverAny(triangles, corners, from, part);
    const std::uint8_t bits[8] = {static_cast<std::uint8_t>(set)};
    const Integer numbers = hn::Add(hn::Iota(integers, 0), all(static_cast<std::int32_t>(from)));
    const auto listed = hn::Compress(numbers, hn::LoadMaskBits(integers, bits));
    hn::StoreU(listed, integers, setup.triangles.data() + setup.count);
    setup.count += static_cast<std::uint32_t>(__builtin_popcount(set));
  }
  hn::StoreU(hn::Zero(integers), integers, setup.triangles.data() + setup.count);  // for the lanes behind the last
}

void setUp(const SmallTriangles& triangles, const Scissor& part, SmallSetup& setup) {
  const auto lanes = static_cast<std::uint32_t>(hn::Lanes(integers));
  const PartCorners corners(triangles);
  listTriangles(triangles, corners, part, setup);
  setup.thin = setup.negative = setup.uniform = 0;
  for (std::uint32_t k = 0; k < setup.count; k += lanes) setUpEntries(triangles, corners, k, part, setup);
}

/// The samples of a triangle in one vector of columns.
struct Strip {
  const SmallSetup& setup;
  std::uint32_t k;
  int i;  ///< the first column, from the first of the triangle

  int firstColumn() const { return setup.firstColumn[k] + i; }
};

/// A plane along a strip.
struct StripPlane {
  Double at, down, right;

  StripPlane(const Strip& strip, const SmallPlanes& planes)
      : at(all(planes.at[strip.k])),
        down(all(planes.down[strip.k])),
        right(hn::Mul(all(planes.right[strip.k]), hn::Add(hn::Iota(doubles, 0), all(static_cast<double>(strip.i))))) {}

  Double inRow(Double j) const { return hn::Add(hn::Add(at, hn::Mul(down, j)), right); }
};

/// An edge along a strip, row by row. Its values are integers, so that sums are exact.
struct StripEdge {
  Double value, down;

  explicit StripEdge(const StripPlane& plane) : value(hn::Add(plane.at, plane.right)), down(plane.down) {}
  void advance() { value = hn::Add(value, down); }
};

/// The texels of a triangle along a strip.
struct StripTexels {
  StripPlane column, row;
  Double clear, columns, lastColumn, lastRow;
  const ItemId* map;

  StripTexels(const Strip& strip, const SmallIds& ids)
      : column(strip, strip.setup.column),
        row(strip, strip.setup.row),
        clear(all(strip.setup.clear[strip.k])),
        columns(all(ids.columns)),
        lastColumn(all(ids.columns - 1)),
        lastRow(all(ids.rows - 1)),
        map(ids.map) {}

  /// The values of the texels of the samples of a mask.
  hn::Vec<Numbers> find(Double j, Double w, hn::Mask<Doubles> shown, hn::Mask<Doubles>& isClear) const {
    const Double across = hn::Mul(column.inRow(j), w), along = hn::Mul(row.inRow(j), w);
    const Double wholeColumn = hn::Floor(across), wholeRow = hn::Floor(along);
    const auto offCentre = [](Double position, Double whole) {
      return hn::Abs(hn::Sub(hn::Sub(position, whole), all(0.5)));
    };
    isClear = hn::And(hn::Lt(offCentre(across, wholeColumn), clear), hn::Lt(offCentre(along, wholeRow), clear));
    const Double inColumns = hn::Max(hn::Min(wholeColumn, lastColumn), hn::Zero(doubles));
    const Double inRows = hn::Max(hn::Min(wholeRow, lastRow), hn::Zero(doubles));
    const Double texel = hn::IfThenElseZero(shown, hn::Add(hn::Mul(inRows, columns), inColumns));
    auto index = hn::DemoteTo(integers, texel);
    if (map != nullptr) index = hn::GatherIndex(integers, reinterpret_cast<const std::int32_t*>(map), index);
    return hn::BitCast(Numbers(), index);
  }
};

/// Draws the samples of a strip. Returns the rows with unresolved samples, one bit each; `unresolved` has one bit per
/// sample of each row.
template <bool isTextured>
std::uint32_t draw(const Strip& strip, const SmallIds& ids, std::uint32_t firstNumber, DepthBuffer& buffer,
                   std::uint8_t* unresolved) {
  const SmallSetup& setup = strip.setup;
  const std::uint32_t k = strip.k;
  const auto inside = hn::FirstN(doubles, static_cast<std::size_t>(setup.columns[k] - strip.i));
  StripEdge a(StripPlane(strip, setup.edges[0])), b(StripPlane(strip, setup.edges[1])),
      c(StripPlane(strip, setup.edges[2]));
  const StripPlane depthPlane(strip, setup.inverseDepth);
  const StripTexels texels(strip, ids);
  const auto number = hn::Set(Numbers(), firstNumber + static_cast<std::uint32_t>(setup.triangles[k]));
  const auto base = hn::Set(Numbers(), ids.ids[k]);
  const std::size_t first = buffer.pixelAt(strip.firstColumn(), setup.firstRow[k]), pitch = buffer.pitch;
  double* depths = buffer.inverseDepth.data() + first;
  std::uint32_t* numbers = buffer.triangle.data() + first;
  ItemId* shown = buffer.id.data() + first;
  const int rows = setup.rows[k];
  std::uint32_t unresolvedRows = 0;
  Double row = hn::Zero(doubles);
  for (int j = 0; j < rows; ++j) {
    const auto covered = hn::And(inside, hn::Ge(hn::Min(hn::Min(a.value, b.value), c.value), hn::Zero(doubles)));
    const Double inverseDepth = depthPlane.inRow(row), difference = hn::Sub(inverseDepth, hn::LoadU(doubles, depths));
    const Double margin = hn::Mul(all(depthMargin), inverseDepth);
    const auto taken = hn::And(covered, hn::Gt(difference, margin));
    auto open = hn::And(covered, hn::Le(hn::Abs(difference), margin));
    const auto takenNumbers = forNumbers(taken);
    hn::BlendedStore(inverseDepth, taken, doubles, depths);
    hn::BlendedStore(number, takenNumbers, Numbers(), numbers);
    auto id = base;
    if (isTextured && !hn::AllFalse(doubles, taken)) {
      auto isClear = covered;
      id = hn::Add(base, texels.find(row, hn::Div(all(1.0), inverseDepth), taken, isClear));
      open = hn::Or(open, hn::AndNot(isClear, taken));
    }
    hn::BlendedStore(id, takenNumbers, Numbers(), shown);
    unresolved[j] = bitsOf(doubles, open);
    unresolvedRows |= std::uint32_t{unresolved[j] != 0} << j;
    a.advance();
    b.advance();
    c.advance();
    row = hn::Add(row, all(1.0));
    depths += pitch;
    numbers += pitch;
    shown += pitch;
  }
  return unresolvedRows;
}

void draw(const SmallSetup& setup, const SmallIds& ids, std::uint32_t firstNumber, DepthBuffer& buffer,
          UnresolvedSamples& unresolved) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  for (std::uint32_t k = 0; k < setup.count; ++k) {
    if (setup.rows[k] == 0) continue;
    for (int i = 0; i < setup.columns[k]; i += lanes) {
      const Strip strip{setup, k, i};
      std::uint8_t open[smallRows];
      std::uint32_t rows = (ids.textured >> k & 1) != 0 ? draw<true>(strip, ids, firstNumber, buffer, open)
                                                        : draw<false>(strip, ids, firstNumber, buffer, open);
      for (; rows != 0; rows &= rows - 1) {
        const int j = __builtin_ctz(rows);
        for (unsigned samples = open[j]; samples != 0; samples &= samples - 1)
          unresolved.add({k, {strip.firstColumn() + __builtin_ctz(samples), setup.firstRow[k] + j}});
      }
    }
  }
}

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE::small
HWY_AFTER_NAMESPACE();
