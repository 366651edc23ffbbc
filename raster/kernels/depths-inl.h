/// Kernels for the depth test of large triangles, and for queries of depth buffers. Lanes hold adjacent samples.
// No include guard: kernels.cpp includes this file once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE::depths {
namespace {

/// One value per vertex of a triangle, each in all lanes.
struct Corners {
  Double a, b, c;

  explicit Corners(const std::array<double, 3>& of)
      : a(hn::Set(doubles, of[0])), b(hn::Set(doubles, of[1])), c(hn::Set(doubles, of[2])) {}
};

/// The values of the edges of a triangle at adjacent samples: exact integers.
struct Edges {
  Double a, b, c;

  Edges(const EdgeValues& first, const Corners& step) {
    const Double lane = hn::Iota(doubles, 0);
    a = hn::Add(hn::Set(doubles, first[0]), hn::Mul(step.a, lane));
    b = hn::Add(hn::Set(doubles, first[1]), hn::Mul(step.b, lane));
    c = hn::Add(hn::Set(doubles, first[2]), hn::Mul(step.c, lane));
  }
  void advance(const Corners& by) {
    a = hn::Add(a, by.a);
    b = hn::Add(b, by.b);
    c = hn::Add(c, by.c);
  }
};

/// The sum of products, added in the order of the vertices, as in the scalar version.
Double dot(const Edges& edges, const Corners& weights) {
  return hn::Add(hn::Add(hn::Mul(edges.a, weights.a), hn::Mul(edges.b, weights.b)), hn::Mul(edges.c, weights.c));
}

/// Lanes that took a triangle, and lanes that are unresolved.
struct Outcome {
  Mask taken = firstLanes(0), unresolved = firstLanes(0);
};

/// A triangle in its depth test against a buffer.
struct Candidate {
  const ScreenTriangle& triangle;
  const DepthBuffer& buffer;
  double* depths;
  std::uint32_t* triangles;
  hn::Vec<Numbers> number;

  Candidate(const ScreenTriangle& tested, std::uint32_t itsNumber, DepthBuffer& to)
      : triangle(tested),
        buffer(to),
        depths(to.inverseDepth.data()),
        triangles(to.triangle.data()),
        number(hn::Set(Numbers(), itsNumber)) {}

  /// The depth test of adjacent samples, limited to the lanes of `covered`.
  void test(Double inverseDepth, std::size_t pixel, Mask covered, Outcome& outcome) const {
    const Double difference = hn::Sub(inverseDepth, hn::LoadU(doubles, depths + pixel));
    const Double margin = hn::Mul(hn::Set(doubles, depthMargin), inverseDepth);
    const Mask taken = hn::And(covered, hn::Gt(difference, margin));
    outcome.taken = hn::Or(outcome.taken, taken);
    outcome.unresolved = hn::Or(outcome.unresolved, hn::And(covered, hn::Le(hn::Abs(difference), margin)));
    hn::BlendedStore(inverseDepth, taken, doubles, depths + pixel);
    hn::BlendedStore(number, forNumbers(taken), Numbers(), triangles + pixel);
  }
};

/// Tests the samples of a triangle in one vector of columns, row by row.
void testStrip(const Candidate& candidate, int column, Outcome& outcome) {
  const ScreenTriangle& triangle = candidate.triangle;
  const Mask inside = firstLanes(triangle.endColumn - column);
  const Corners down(edgeRowSteps(triangle)), inverseDepth(triangle.inverseDepth), least(minCovered(triangle));
  Edges edges(edgeValues(triangle, column, triangle.firstRow), Corners(edgeSteps(triangle)));
  std::size_t pixel = candidate.buffer.pixelAt(column, triangle.firstRow);
  for (int row = triangle.firstRow; row < triangle.endRow; ++row) {
    const Mask covered =
        hn::And(hn::And(inside, hn::Ge(edges.a, least.a)), hn::And(hn::Ge(edges.b, least.b), hn::Ge(edges.c, least.c)));
    candidate.test(dot(edges, inverseDepth), pixel, covered, outcome);
    pixel += candidate.buffer.pitch;
    edges.advance(down);
  }
}

/// For narrow triangles: tests all samples of the bounding box.
Outcome testNarrow(const Candidate& candidate) {
  Outcome outcome;
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  for (int column = candidate.triangle.firstColumn; column < candidate.triangle.endColumn; column += lanes)
    testStrip(candidate, column, outcome);
  return outcome;
}

/// The covered columns [first, end) of several rows, one row per lane. Coverage is convex, so that each edge gives one
/// bound.
///
/// An edge changes by less than 2^32 per pixel. So a quotient that is not an integer differs from one by at least 1/|a|
/// > 2^-32. Quotients are below 2^13, where division rounds by less than that. So no quotient rounds to an integer.
struct Spans {
  HWY_ALIGN std::int32_t first[maxLanes], end[maxLanes];
  std::uint32_t covered;  ///< one bit per row with a covered column

  Spans(const ScreenTriangle& triangle, const EdgeValues& least, int firstRow) {
    const Double rows = hn::Add(hn::Set(doubles, static_cast<double>(firstRow)), hn::Iota(doubles, 0));
    Double low = hn::Set(doubles, static_cast<double>(triangle.firstColumn));
    Double high = hn::Set(doubles, static_cast<double>(triangle.endColumn));
    for (std::size_t k = 0; k < 3; ++k) {
      const Edge& edge = triangle.edges[k];
      const Double step = hn::Set(doubles, static_cast<double>(edge.a));
      const Double atZero = hn::Add(hn::Mul(hn::Set(doubles, static_cast<double>(edge.b)), rows),
                                    hn::Set(doubles, static_cast<double>(edge.c)));
      const Double missing = hn::Sub(hn::Set(doubles, least[k]), atZero);
      if (edge.a > 0) low = hn::Max(low, hn::Ceil(hn::Div(missing, step)));
      if (edge.a < 0) high = hn::Min(high, hn::Add(hn::Floor(hn::Div(missing, step)), hn::Set(doubles, 1.0)));
      if (edge.a == 0) high = hn::IfThenElse(hn::Gt(missing, hn::Zero(doubles)), low, high);
    }
    covered = bitsOf(doubles, hn::Lt(low, high));
    hn::Store(hn::DemoteTo(Integers(), low), Integers(), first);
    hn::Store(hn::DemoteTo(Integers(), high), Integers(), end);
  }
};

/// Tests the samples of a row from `column` to `end`, all covered, with 1/w from a plane.
void testSpan(const Candidate& candidate, const DepthPlane& plane, int row, int column, int end, Outcome& outcome) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  const Double at = hn::Set(doubles, plane.at + plane.down * row), right = hn::Set(doubles, plane.right);
  Double columns = hn::Add(hn::Set(doubles, static_cast<double>(column)), hn::Iota(doubles, 0));
  std::size_t pixel = candidate.buffer.pixelAt(column, row);
  for (; column < end; column += lanes, pixel += hn::Lanes(doubles)) {
    candidate.test(hn::Add(at, hn::Mul(right, columns)), pixel, firstLanes(end - column), outcome);
    columns = hn::Add(columns, hn::Set(doubles, static_cast<double>(lanes)));
  }
}

/// As above, with 1/w from the edges.
void testSpan(const Candidate& candidate, int row, int column, int end, Outcome& outcome) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  const EdgeValues steps = edgeSteps(candidate.triangle);
  const Corners stride({lanes * steps[0], lanes * steps[1], lanes * steps[2]});
  const Corners inverseDepth(candidate.triangle.inverseDepth);
  Edges edges(edgeValues(candidate.triangle, column, row), Corners(steps));
  std::size_t pixel = candidate.buffer.pixelAt(column, row);
  for (; column < end; column += lanes, pixel += hn::Lanes(doubles)) {
    candidate.test(dot(edges, inverseDepth), pixel, firstLanes(end - column), outcome);
    edges.advance(stride);
  }
}

Outcome testWide(const Candidate& candidate) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  const ScreenTriangle& triangle = candidate.triangle;
  const std::optional<DepthPlane> plane = depthPlane(triangle);
  const EdgeValues least = minCovered(triangle);
  Outcome outcome;
  for (int firstRow = triangle.firstRow; firstRow < triangle.endRow; firstRow += lanes) {
    const Spans spans(triangle, least, firstRow);
    const std::uint32_t inside = (1U << std::min(lanes, triangle.endRow - firstRow)) - 1;
    for (std::uint32_t left = spans.covered & inside; left != 0; left &= left - 1) {
      const int i = __builtin_ctz(left);
      if (plane)
        testSpan(candidate, *plane, firstRow + i, spans.first[i], spans.end[i], outcome);
      else
        testSpan(candidate, firstRow + i, spans.first[i], spans.end[i], outcome);
    }
  }
  return outcome;
}

/// Whether most of many rows cover no sample: the area is below a quarter of a pixel per row.
bool isNeedle(const ScreenTriangle& triangle) {
  constexpr std::int64_t quarterPixel = 2 * 256 * 256 / 4;  // doubled, in square sub-pixels
  const int rows = triangle.endRow - triangle.firstRow;
  return rows > static_cast<int>(maxVertexLanes) && triangle.area < quarterPixel * rows;
}

bool testDepths(const ScreenTriangle& triangle, std::uint32_t number, DepthBuffer& buffer,
                UnresolvedPixels& unresolved) {
  const bool isNarrow = triangle.endColumn - triangle.firstColumn <= maxLanes && !isNeedle(triangle);
  const Candidate candidate(triangle, number, buffer);
  const Outcome outcome = isNarrow ? testNarrow(candidate) : testWide(candidate);
  if (!hn::AllFalse(doubles, outcome.unresolved)) listUnresolvedSamples(triangle, number, buffer, unresolved);
  return !hn::AllFalse(doubles, outcome.taken);
}

bool isHidden(const DepthBuffer& buffer, const Scissor& part, double inverseDepth) {
  const auto lanes = static_cast<int>(hn::Lanes(doubles));
  const Double limit = hn::Set(doubles, inverseDepth);
  for (int row = part.row; row < part.row + part.height; ++row) {
    const double* const depths = buffer.inverseDepth.data() + buffer.rowAt(row) + (part.column - buffer.scissor.column);
    for (int i = 0; i < part.width; i += lanes) {
      const Mask seen = hn::And(firstLanes(part.width - i), hn::Le(hn::LoadU(doubles, depths + i), limit));
      if (!hn::AllFalse(doubles, seen)) return false;
    }
  }
  return true;
}

int endOfRun(const std::uint32_t* triangles, int first, int end) {
  const hn::CappedTag<std::uint32_t, maxLanes> numbers;
  const auto lanes = static_cast<int>(hn::Lanes(numbers));
  const auto shown = hn::Set(numbers, triangles[first]);
  for (int i = first; i < end; i += lanes) {
    const auto other = hn::FindFirstTrue(numbers, hn::Ne(hn::LoadU(numbers, triangles + i), shown));
    if (other >= 0) return std::min(i + static_cast<int>(other), end);
  }
  return end;
}

int endOfSmall(const std::uint32_t* triangles, int first, int end) {
  const hn::CappedTag<std::int32_t, maxLanes> numbers;
  const auto lanes = static_cast<int>(hn::Lanes(numbers));
  for (int i = first; i < end; i += lanes) {
    // As signed integers, the numbers of small triangles are at most -2.
    const auto shown = hn::BitCast(numbers, hn::LoadU(hn::CappedTag<std::uint32_t, maxLanes>(), triangles + i));
    const auto other = hn::FindFirstTrue(numbers, hn::Gt(shown, hn::Set(numbers, -2)));
    if (other >= 0) return std::min(i + static_cast<int>(other), end);
  }
  return end;
}

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE::depths
HWY_AFTER_NAMESPACE();
