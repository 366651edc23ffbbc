/// Vectors of version 2: small pictures of at most 8 x 8 pixels, one or more for each rule that it adds.
#include <cmath>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {
namespace {

using namespace raster;

constexpr int side = 8;

/// A draw list in clip space, laid out in the pixels of a face.
struct ClipPicture : DrawList {
  explicit ClipPicture(ClipDepth range = ClipDepth::ZeroToOne) : DrawList(plainList()) { clipDepth = range; }

  /// Adds a vertex at (column, row) with the depth z/w; returns its index.
  std::uint32_t vertex(double column, double row, double depth = 0.5, double w = 1) {
    const auto across = [&](double pixels) { return static_cast<float>((2 * pixels / side - 1) * w); };
    positions.emplace_back(across(column), across(row), static_cast<float>(w));
    clipZ.push_back(static_cast<float>(depth * w));
    texcoords.emplace_back(static_cast<float>(column) / side, static_cast<float>(row) / side);
    return static_cast<std::uint32_t>(positions.size()) - 1;
  }

  /// Adds indices to the last draw.
  void draw(std::initializer_list<std::uint32_t> added) {
    indices.insert(indices.end(), added);
    draws.back().count += static_cast<std::uint32_t>(added.size());
  }

  /// Adds a rectangle to the last draw, counter-clockwise.
  void block(const Block& block, double depth = 0.5, double w = 1) {
    const auto& [column, row, endColumn, endRow] = block;
    const std::uint32_t a = vertex(column, row, depth, w), b = vertex(endColumn, row, depth, w),
                        c = vertex(endColumn, endRow, depth, w), d = vertex(column, endRow, depth, w);
    draw({a, d, b, b, d, c});
  }
};

constexpr Block whole{0, 0, side, side};

Face clipFace(bool rowsUpwards = false) {
  Face face = frontFace(side, 0x1p-20F);
  if (rowsUpwards) face.y = -face.y;
  return face;
}

TestVector vectorOf(const char* name, const char* catches, const DrawList& list) {
  return makeVector(name, catches, list, {clipFace()});
}

/// Four random triangles in front of a wall. Their depths are those of a perspective view with a near plane at 1/4.
TestVector perspective() {
  std::mt19937 random(3);
  ClipPicture picture;
  picture.indexMaps.push_back(countingMap(4, 4));
  addDraw(picture, 0x100);
  picture.block(whole, 0.99, 2);
  for (ItemId id = 2; id < 6; ++id) {
    addDraw(picture, id << 8, 0x10000 + id, 0);
    const auto corner = [&] {
      const double w = uniform(random, 0.1F, 2), column = uniform(random, -6, 14), row = uniform(random, -6, 14);
      return picture.vertex(column, row, 1.02 - 0.25 / w, w);
    };
    const std::uint32_t a = corner(), b = corner(), c = corner();
    picture.draw({a, b, c});
  }
  return vectorOf("clip-perspective", "z/w of a perspective view, its near plane, and w for texels", picture);
}

TestVector orthographic() {
  std::mt19937 random(9);
  ClipPicture picture;
  for (ItemId id = 0; id < 12; ++id) {
    addDraw(picture, id);
    const int column = static_cast<int>(random() % 6), row = static_cast<int>(random() % 6);
    picture.block({column, row, column + 3, row + 3}, (static_cast<double>(random() % 9) - 0.5) / 8);
  }
  return vectorOf("clip-orthographic", "w = 1 everywhere, depths before 0 and beyond 1", picture);
}

/// Triangles behind the eye, whose projection through it would cover the wall.
TestVector behindTheEye() {
  ClipPicture picture;
  addDraw(picture, 1);
  picture.block(whole, 0.9);
  addDraw(picture, 2);
  picture.block({1, 1, 6, 5}, 0.5, -1);
  picture.block({3, 4, 7, 8}, 0.25, -2);
  return vectorOf("clip-behind", "triangles with w < 0 drawn", picture);
}

/// Triangles between points before and behind the eye, or with a corner at w = 0.
TestVector signsOfW() {
  ClipPicture picture;
  addDraw(picture, 1);
  picture.block(whole, 0.9);
  const auto infinite = [&](float x, float y) {
    const std::uint32_t index = picture.vertex(0, 0, 0, 0);
    picture.positions[index] = {x, y, 0};
    return index;
  };
  addDraw(picture, 2);
  picture.draw({picture.vertex(1, 1), picture.vertex(4, 6), infinite(1, -0.25F)});
  addDraw(picture, 3);
  picture.draw({picture.vertex(2, 5, 0.5, 1), picture.vertex(5, 7, 0.25, 2), picture.vertex(3, 3, 0.5, -1)});
  addDraw(picture, 4);
  picture.draw({picture.vertex(6, 1), infinite(-1, 1), infinite(-1, 0.5F)});
  return vectorOf("clip-signs-of-w", "division before clipping: corners with w <= 0", picture);
}

TestVector guardBand() {
  ClipPicture picture;
  addDraw(picture, 1);
  picture.block({-40, -40, 44, 5}, 0.5);
  addDraw(picture, 2);
  picture.draw({picture.vertex(-300, 2, 0.25), picture.vertex(4, 90, 0.25), picture.vertex(35, -30, 0.25)});
  return vectorOf("clip-guard-band", "coordinates that overflow beyond the picture", picture);
}

/// A ramp from z = -2w to 2w.
TestVector minusOneToOne() {
  ClipPicture picture(ClipDepth::MinusOneToOne);
  for (ItemId id = 0; id < side; ++id) {
    addDraw(picture, id);
    const double first = static_cast<double>(id), w = 1 + first / 4;
    const std::uint32_t a = picture.vertex(0, first, -2, w), b = picture.vertex(side, first, 2, w),
                        c = picture.vertex(side, first + 1, 2, w), d = picture.vertex(0, first + 1, -2, w);
    picture.draw({a, d, b, b, d, c});
  }
  return vectorOf("clip-minus-one-to-one", "z clipped to 0..w where it is from -w to w", picture);
}

/// Depths that are 1 at the near plane, with a block at each end of the range.
TestVector reversed() {
  ClipPicture picture;
  picture.depthTest = DepthTest::FartherOrEqual;
  addDraw(picture, 1);
  picture.block({0, 0, 4, 8}, 1);
  addDraw(picture, 2);
  picture.block({2, 0, 8, 4}, 0.5);
  addDraw(picture, 3);
  picture.block({3, 2, 8, 8}, 0.25);
  addDraw(picture, 4);
  picture.block({6, 6, 8, 8}, 0);
  return vectorOf("clip-reversed", "reversed depths with the clear or the comparison of usual ones", picture);
}

/// Both windings, with a back item ID, culled and not. The second face has rows upwards.
TestVector windings(const char* name, const char* catches, Winding front) {
  ClipPicture picture;
  picture.front = front;
  const auto add = [&](ItemId id, int column, Cull cull, bool isTurned) {
    addDraw(picture, id, 0x100 + id);
    picture.draws.back().cull = cull;
    picture.block({column, static_cast<int>(id), column + 4, side});
    if (isTurned) turnLastDraw(picture);
  };
  add(1, 0, Cull::None, false);
  add(2, 0, Cull::Back, true);
  add(3, 4, Cull::None, true);
  add(4, 4, Cull::Front, false);
  return makeVector(name, catches, picture, {clipFace(), clipFace(true)}, {"downwards", "upwards"});
}

/// The corners of a board of `columns` x 2 cells, each with its number as value.
void addBoard(ClipPicture& picture, int columns) {
  for (int row = 0; row <= 2; ++row)
    for (int column = 0; column <= columns; ++column) picture.vertex(column * side / columns, row * side / 2);
}

/// A strip over the upper half of a board and a fan over the lower one.
ClipPicture stripAndFan() {
  ClipPicture picture;
  addBoard(picture, 4);
  addDraw(picture, 0x100);
  picture.draws.back().topology = Topology::Strip;
  picture.draw({0, 5, 1, 6, 2, 7, 3, 8, 4, 9});
  addDraw(picture, 0x200);
  picture.draws.back().topology = Topology::Fan;
  picture.draw({5, 10, 11, 12, 13, 14, 9});
  return picture;
}

TestVector topologies() {
  ClipPicture picture = stripAndFan();
  picture.value = PixelValue::TriangleNumbers;
  for (Draw& draw : picture.draws) draw.cull = Cull::Back;
  return vectorOf("strip-and-fan", "every other triangle of a strip turned over, numbers of strips and fans", picture);
}

TestVector provoking(const char* name, Provoking vertex) {
  ClipPicture picture = stripAndFan();
  picture.value = PixelValue::VertexValues;
  picture.provoking = vertex;
  for (ItemId v = 0; v < picture.positions.size(); ++v) picture.vertexValues.push_back(10 * v);
  return vectorOf(name, "flat values of the other vertex", picture);
}

/// Strips or triangles with restarts, in the largest index of 16 or 32 bits.
TestVector restarts(const char* name, int bits, Topology topology, PixelValue value) {
  ClipPicture picture;
  picture.indexBits = bits;
  picture.value = value;
  addBoard(picture, 4);
  const std::uint32_t cut = bits == 16 ? 0xffff : 0xffffffff;
  for (const std::uint32_t first : {0U, 5U}) {
    addDraw(picture, (first + 1) << 8);
    Draw& draw = picture.draws.back();
    draw.topology = topology;
    draw.restarts = true;
    draw.baseVertex = first;
    if (topology == Topology::Strip) picture.draw({0, 5, cut, 0, 5, 1, 6, cut, 2, 7, 3, 8, 4, 9});
    if (topology == Topology::Fan) picture.draw({0, 5, 6, 1, cut, 0, cut, 2, 1, 6, 7, cut, 3, 7, 8, 9, 4});
    if (topology == Topology::Triangles) picture.draw({0, 5, cut, 0, 5, 1, 1, 5, 6, 2, cut, 3, 7, 8, 4, 3, 8, 4, 8, 9});
  }
  return vectorOf(name, "primitive restart: numbers after it, and what it cuts off", picture);
}

/// Triangles whose pairs are equal but for the draw, or but for the triangle.
TestVector pairs() {
  ClipPicture picture;
  picture.value = PixelValue::Pairs;
  for (const int strip : {0, 1, 2, 3}) {
    addDraw(picture, strip == 3 ? 0xfffffffe : static_cast<ItemId>(70000 * strip));
    picture.block({0, 2 * strip, 4, 2 * strip + 2});
    picture.block({4, 2 * strip, 8, 2 * strip + 2});
    if (strip == 1) picture.block({2, 2, 6, 4}, 0.25);
  }
  return vectorOf("pairs", "primitive IDs of another draw, and pairs cut to fewer bits", picture);
}

TestVector numberedDraws() {
  ClipPicture picture;
  picture.value = PixelValue::TriangleNumbers;
  for (int row = 0; row < 4; ++row) {
    addDraw(picture, static_cast<ItemId>(row) << 8);
    for (int column = 0; column <= row; ++column) picture.block({2 * column, 2 * row, 2 * column + 2, 2 * row + 2});
  }
  return vectorOf("triangle-numbers", "primitive IDs that count on from draw to draw", picture);
}

/// A vertex beyond the first 65,536, which 16-bit indices reach with a base vertex.
TestVector baseVertex() {
  ClipPicture picture;
  picture.indexBits = 16;
  picture.value = PixelValue::TriangleNumbers;
  for (int v = 0; v < 65500; ++v) picture.vertex(v % 7, v % 5, 0.75);
  addDraw(picture, 0x100);
  picture.block({0, 0, 8, 3});
  picture.block({0, 3, 8, 8});
  for (std::uint32_t& index : picture.indices) index -= 65400;
  picture.draws.back().baseVertex = 65400;
  for (int v = 0; v < 60; ++v) picture.vertex(v % 5, v % 7, 0.75);
  addDraw(picture, 0x200);
  picture.block({2, 1, 7, 6}, 0.25);
  for (std::uint32_t k = 0; k < 6; ++k) picture.indices[picture.draws.back().first + k] -= 65400;
  picture.draws.back().baseVertex = 65400;
  return vectorOf("base-vertex", "16-bit indices that wrap when the base vertex is added", picture);
}

TestVector instances(const char* name, bool areMirrored) {
  ClipPicture picture;
  picture.value = PixelValue::TriangleNumbers;
  addDraw(picture, 0);
  picture.block({0, 0, 4, 3});
  picture.draw({picture.vertex(0, 3), picture.vertex(0, 4), picture.vertex(4, 3)});
  picture.draws.back().cull = Cull::Back;
  picture.draws.back().instances = 4;
  addDraw(picture, 0x10000, 0x20000);
  picture.draw({picture.vertex(0, 0, 0.25), picture.vertex(1, 3, 0.25), picture.vertex(3, 1, 0.25)});
  picture.draws.back().firstInstance = 1;
  picture.draws.back().instances = 3;
  const float x = areMirrored ? -1 : 1;
  const glm::vec4 flat(1.0F), turned(x, x, 1, 1), mirrored(x, 1, 1, 1);
  const auto moved = [](float columns, float rows) { return glm::vec4(columns / 4, rows / 4, 0, 0); };
  picture.instances = {{flat, moved(0, 0), 0x100},
                       {mirrored, areMirrored ? moved(0, 0) : moved(4, 0), 0x200},
                       {turned, areMirrored ? moved(0, 0) : moved(0, 4), 0x300},
                       {flat, moved(4, 4), 0x400}};
  return vectorOf(name, "the transformation or the number of another instance, and facing of mirrored ones", picture);
}

TestVector passedSamples(const char* name, DepthTest test) {
  ClipPicture picture;
  picture.value = PixelValue::PassedSamples;
  picture.depthTest = test;
  for (const double depth : {0.5, 0.25, 0.25, 0.75, 0.125}) {
    addDraw(picture, 0);
    const double move = 8 * depth - 2;
    picture.draw({picture.vertex(move - 1, 0, depth), picture.vertex(move, 8, depth), picture.vertex(8, 3, depth)});
  }
  return vectorOf(name, "fragments that fail, and pixels of quads at edges, counted", picture);
}

/// 64 pairs of triangles whose depths differ by multiples of a quarter of the smallest step.
TestVector storedDepths(const char* name, DepthPrecision precision, double step) {
  ClipPicture picture;
  picture.depthPrecision = precision;
  for (int pixel = 0; pixel < side * side; ++pixel) {
    const double depth = precision == DepthPrecision::Float32 ? std::ldexp(0.75, -pixel / 8) : 0.3 + pixel * 0.01;
    const double unit = precision == DepthPrecision::Float32 ? std::ldexp(step, -pixel / 8) : step;
    for (const int later : {0, 1}) {
      addDraw(picture, static_cast<ItemId>(2 * pixel + later));
      const double column = pixel % side, row = pixel / side, d = depth - later * unit * (pixel % 8) / 4;
      const double slope = precision == DepthPrecision::Float32 ? unit : 0;
      picture.draw({picture.vertex(column + 0.125, row + 0.125, d),
                    picture.vertex(column + 0.25, row + 0.875, d + slope),
                    picture.vertex(column + 0.875, row + 0.5, d - slope)});
    }
  }
  return vectorOf(name, "depths of more or fewer bits than the stated ones", picture);
}

/// What a scene shows with another depth test.
TestVector sceneDepths(const char* name, DepthTest test) {
  Picture picture(side);
  picture.depthTest = test;
  for (ItemId id = 0; id < 9; ++id) {
    addDraw(picture, id);
    const int column = static_cast<int>(id * 5 % 7) - 1, row = static_cast<int>(id * 3 % 7) - 1;
    picture.addBlock({column, row, column + 4, row + 4}, 1 + id * 4 % 3);
  }
  return makeVector(name, "the comparison of depths, and which of equal ones stays", picture);
}

TestVector sceneHoles() {
  Picture picture(side);
  IndexMap map = countingMap(8, 8);
  for (std::size_t k = 0; k < map.ids.size(); k += 3) map.ids[k] = holeTexel;
  picture.indexMaps.push_back(map);
  addDraw(picture, 0x100, 0x1ff, 0);
  picture.addBlock({0, 0, 8, 6});
  addDraw(picture, 0x200, 0x2ff, 0);
  picture.addBlock({0, 2, 8, 8}, 2);
  turnLastDraw(picture);
  addDraw(picture, 0x300);
  picture.draws.back().cull = Cull::Front;
  picture.addBlock({4, 4, 8, 8}, 0.75);
  return makeVector("holes-and-culling", "holes that hide, holes filled on backs, the wrong side culled", picture);
}

TestVector sceneViewport(const char* name, int columns, int rows, SamplePlace place) {
  std::mt19937 random(static_cast<unsigned>(columns));
  Picture picture(side);
  picture.value = PixelValue::TriangleNumbers;
  addDraw(picture, 1);
  for (int k = 0; k < 9; ++k) {
    const auto point = [&] {
      const double column = static_cast<double>(random() % 17) / 2, row = static_cast<double>(random() % 17) / 2;
      return picture.point({column, row}, 1 + k % 3);
    };
    const glm::vec3 a = point(), b = point(), c = point();
    addTriangle(picture, {a, b, c});
  }
  Face face = frontFace(side, 0.5F);
  face.viewport = Viewport{columns, rows};
  face.sample = place;
  face.scissor = {0, 0, columns, rows};
  return makeVector(name, "viewports that are no squares, and samples half a pixel off", picture, {face});
}

}  // namespace

std::vector<TestVector> drawVectors() {
  return {perspective(),
          orthographic(),
          behindTheEye(),
          signsOfW(),
          guardBand(),
          minusOneToOne(),
          reversed(),
          windings("front-counter-clockwise", "winding flipped with y, and a face of the frame before",
                   Winding::CounterClockwise),
          windings("front-clockwise", "the winding of fronts", Winding::Clockwise),
          topologies(),
          provoking("provoking-first", Provoking::First),
          provoking("provoking-last", Provoking::Last),
          restarts("restart-strip", 32, Topology::Strip, PixelValue::TriangleNumbers),
          restarts("restart-fan", 16, Topology::Fan, PixelValue::Pairs),
          restarts("restart-triangles", 16, Topology::Triangles, PixelValue::TriangleNumbers),
          pairs(),
          numberedDraws(),
          baseVertex(),
          instances("instances", false),
          instances("instances-mirrored", true),
          passedSamples("passed-samples", DepthTest::Nearer),
          passedSamples("passed-samples-reversed", DepthTest::FartherOrEqual),
          storedDepths("depth-unorm16", DepthPrecision::Unorm16, 1.0 / 0xffff),
          storedDepths("depth-unorm24", DepthPrecision::Unorm24, 1.0 / 0xffffff),
          storedDepths("depth-float32", DepthPrecision::Float32, 0x1p-24),
          sceneDepths("depth-nearer-or-equal", DepthTest::NearerOrEqual),
          sceneDepths("depth-farther", DepthTest::Farther),
          sceneDepths("depth-farther-or-equal", DepthTest::FartherOrEqual),
          sceneHoles(),
          sceneViewport("viewport-7x3", 7, 3, SamplePlace::Middle),
          sceneViewport("viewport-1x8", 1, 8, SamplePlace::Middle),
          sceneViewport("sample-corner", 8, 8, SamplePlace::Corner)};
}

}  // namespace hemitex::reference
