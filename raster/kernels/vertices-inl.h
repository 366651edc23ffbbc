/// Kernels for vertices: view and snap. Lanes hold vertices, then triangles.
// No include guard: kernels.cpp includes this file once per instruction set.

HWY_BEFORE_NAMESPACE();
namespace hemitex::raster::HWY_NAMESPACE::vertices {
namespace {

/// `bit` in the lanes of a mask, else 0.
Integer bitWhere(hn::Mask<Floats> mask, std::int32_t bit) {
  return hn::IfThenElseZero(hn::RebindMask(integers, mask), all(bit));
}

/// The snapped position of x / w; see snap in triangle_setup.cpp.
Integer snapped(Float x, Float w, int resolution) {
  const auto set = [](double value) { return hn::Set(doubles, value); };
  const Double q = hn::Div(hn::PromoteTo(doubles, x), hn::PromoteTo(doubles, w));
  const Double clamped = hn::Min(hn::Max(q, set(-8)), set(8));
  const Double position = hn::Mul(hn::Add(clamped, set(1)), set(128.0 * resolution));
  const Double integer = hn::Sub(hn::Add(position, set(0x1.8p52)), set(0x1.8p52));
  return hn::DemoteTo(integers, integer);
}

struct VertexStage {
  const Face& face;

  Float along(const glm::vec3& row, Float x, Float y, Float z) const {
    return hn::Add(hn::Add(hn::Mul(all(row.x), x), hn::Mul(all(row.y), y)), hn::Mul(all(row.z), z));
  }

  void place(const float* xs, const float* ys, const float* zs, std::size_t i, PlacedVertices& placed) const {
    const Float dx = hn::Sub(hn::LoadU(floats, xs + i), all(face.eye.x));
    const Float dy = hn::Sub(hn::LoadU(floats, ys + i), all(face.eye.y));
    const Float dz = hn::Sub(hn::LoadU(floats, zs + i), all(face.eye.z));
    const Float x = along(face.x, dx, dy, dz), y = along(face.y, dx, dy, dz), w = along(face.w, dx, dy, dz);
    const Float across = hn::Abs(x), down = hn::Abs(y);
    const auto finite = hn::And(hn::And(hn::IsFinite(x), hn::IsFinite(y)), hn::IsFinite(w));
    const auto inFront = hn::And(finite, hn::Ge(w, all(face.nearDistance)));
    const Float guard = hn::Mul(all(static_cast<float>(guardBand)), w), width = hn::Mul(all(2.0F), hn::Abs(w));
    const auto inside = hn::And(inFront, hn::And(hn::Le(across, guard), hn::Le(down, guard)));
    const auto wideX = hn::And(finite, hn::Gt(across, width)), wideY = hn::And(finite, hn::Gt(down, width));
    const Float zero = hn::Zero(floats);
    Integer sides = hn::Or(bitWhere(hn::AndNot(inFront, finite), beyondNear), bitWhere(hn::Not(inside), notInside));
    sides = hn::Or(sides, hn::Or(bitWhere(hn::And(wideX, hn::Gt(x, zero)), beyondRight),
                                 bitWhere(hn::And(wideX, hn::Lt(x, zero)), beyondLeft)));
    sides = hn::Or(sides, hn::Or(bitWhere(hn::And(wideY, hn::Gt(y, zero)), beyondBottom),
                                 bitWhere(hn::And(wideY, hn::Lt(y, zero)), beyondTop)));
    const auto keep = hn::RebindMask(integers, inside);
    hn::StoreU(w, floats, placed.w.data() + i);
    hn::StoreU(sides, integers, placed.sides.data() + i);
    hn::StoreU(hn::IfThenElseZero(keep, snapped(x, w, face.resolution)), integers, placed.x.data() + i);
    hn::StoreU(hn::IfThenElseZero(keep, snapped(y, w, face.resolution)), integers, placed.y.data() + i);
  }
};

/// The three vertices of adjacent triangles.
struct Corners {
  Integer a, b, c;

  Corners(const ClusterMesh& mesh, std::size_t triangle) {
    const auto load = [&](std::size_t k) {
      return hn::PromoteTo(integers, hn::LoadU(Bytes(), mesh.corners[k].data() + triangle));
    };
    a = load(0);
    b = load(1);
    c = load(2);
  }
};

/// The smallest and the largest of three snapped values.
struct Span {
  Integer least, largest;

  Span(const std::int32_t* values, const Corners& at) {
    const Integer a = hn::GatherIndex(integers, values, at.a), b = hn::GatherIndex(integers, values, at.b),
                  c = hn::GatherIndex(integers, values, at.c);
    least = hn::Min(hn::Min(a, b), c);
    largest = hn::Max(hn::Max(a, b), c);
  }

  /// The number of samples of pixels [first, first + count), or a negative number if there are none.
  Integer samplesIn(int first, int count) const {
    const Integer begin = hn::Max(hn::ShiftRight<8>(hn::Add(least, all(127))), all(first));
    return hn::Sub(hn::Min(hn::ShiftRight<8>(hn::Add(largest, all(128))), all(first + count)), begin);
  }
  hn::Mask<Integers> isSmall() const { return hn::Lt(hn::Sub(largest, least), all(smallSpan)); }
};

TriangleSets place(const ClusterMesh& mesh, const ClusterPart& part, const Face& face, PlacedVertices& placed) {
  const std::size_t lanes = hn::Lanes(integers);
  const VertexStage stage{face};
  for (std::size_t i = 0; i < part.vertices; i += lanes)
    stage.place(mesh.positions[0].data() + part.firstVertex, mesh.positions[1].data() + part.firstVertex,
                mesh.positions[2].data() + part.firstVertex, i, placed);
  TriangleSets sets;
  for (std::uint32_t t = 0; t < part.triangles; t += static_cast<std::uint32_t>(lanes)) {
    const Corners at(mesh, part.firstTriangle + t);
    const Integer a = hn::GatherIndex(integers, placed.sides.data(), at.a),
                  b = hn::GatherIndex(integers, placed.sides.data(), at.b),
                  c = hn::GatherIndex(integers, placed.sides.data(), at.c);
    const auto there = hn::FirstN(integers, part.triangles - t);
    const auto seen = hn::And(there, hn::Eq(hn::And(hn::And(a, b), hn::And(c, all(beyondAny))), hn::Zero(integers)));
    const auto uncut = hn::Eq(hn::And(hn::Or(hn::Or(a, b), c), all(notInside)), hn::Zero(integers));
    const Span across(placed.x.data(), at), down(placed.y.data(), at);
    const Integer columns = across.samplesIn(face.scissor.column, face.scissor.width);
    const Integer rows = down.samplesIn(face.scissor.row, face.scissor.height);
    const auto whole = hn::And(hn::And(seen, uncut), hn::Gt(hn::Min(columns, rows), hn::Zero(integers)));
    const auto small = hn::And(whole, hn::And(across.isSmall(), down.isSmall()));
    sets.whole |= std::uint32_t{bitsOf(integers, whole)} << t;
    sets.small |= std::uint32_t{bitsOf(integers, small)} << t;
    sets.tiny |= std::uint32_t{bitsOf(integers, hn::And(small, hn::Lt(hn::Max(columns, rows), all(3))))} << t;
    sets.cut |= std::uint32_t{bitsOf(integers, hn::AndNot(uncut, seen))} << t;
  }
  return sets;
}

}  // namespace
}  // namespace hemitex::raster::HWY_NAMESPACE::vertices
HWY_AFTER_NAMESPACE();
