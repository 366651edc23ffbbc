// The families of random vectors of version 2 of the rules.
#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "reference/conformance/vectors/random_drawings.h"
#include "reference/conformance/vectors/random_vectors.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

/// A family of version 1, which must exist.
auto familyNamed(std::string_view name) {
  const std::vector<RandomFamily>& families = randomFamilies();
  return std::find_if(families.begin(), families.end(), [&](const RandomFamily& family) { return family.name == name; })
      ->make;
}

/// Makes a third of all texels holes.
void punch(Drawing& drawing, Random& random) {
  for (raster::IndexMap& map : drawing.list.indexMaps)
    for (ItemId& texel : map.ids)
      if (random.isOneIn(3)) texel = raster::holeTexel;
}

/// Holes in the maps of other families: at equal depths, on texel borders, in clipped triangles, on backs.
Drawing holes(Random& random) {
  const auto family = familyNamed(
      random.oneOf({"generic", "slivers", "near-plane", "depth-ties", "equal-depths", "texel-borders", "minified-maps",
                    "constant-coordinates", "facing", "views", "channel-sums", "integer-sums", "replaced-ids"}));
  Drawing drawing = family(random);
  punch(drawing, random);
  return drawing;
}

/// Draws of other families that cull.
Drawing culledSides(Random& random) {
  const auto family = familyNamed(random.oneOf(
      {"generic", "slivers", "sample-ties", "near-plane", "guard-band", "equal-depths", "facing", "views"}));
  Drawing drawing = family(random);
  for (raster::Draw& draw : drawing.list.draws)
    draw.cull = random.oneOf({raster::Cull::None, raster::Cull::Front, raster::Cull::Back});
  return drawing;
}

/// Sheets with a draw for each side, which culls backs. Both sides have holes of their own, and equal depths.
Drawing twoSided(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  for (int k = 0; k < 4; ++k) {
    const Corners p = anyCorners(random);
    add(drawing, random, p);
    add(drawing, random, {p[0], p[2], p[1]});
  }
  for (raster::Draw& draw : drawing.list.draws) draw.cull = raster::Cull::Back;
  punch(drawing, random);
  drawing.faces.push_back(drawing.faces[0]);
  drawing.faces[1].x = -drawing.faces[1].x;
  return drawing;
}

/// Triangles of other families in two draws, numbered; some in maps with holes.
Drawing triangleNumbers(Random& random) {
  const auto family = familyNamed(random.oneOf(
      {"generic", "slivers", "near-plane", "guard-band", "equal-depths", "facing", "views", "shared-vertices"}));
  Drawing drawing = family(random);
  if (random.isOneIn(2)) punch(drawing, random);
  drawing.list.value = raster::PixelValue::TriangleNumbers;
  std::vector<raster::Draw>& draws = drawing.list.draws;
  draws.resize(2);
  draws[0].count = 3 * (1 + random.below(static_cast<std::uint32_t>(drawing.list.indices.size()) / 3 - 1));
  draws[1].first = draws[0].count;
  draws[1].count = static_cast<std::uint32_t>(drawing.list.indices.size()) - draws[1].first;
  draws[1].cull = random.oneOf({raster::Cull::None, raster::Cull::Front, raster::Cull::Back});
  return drawing;
}

/// Other families with a depth test that is not the usual one.
Drawing depthTests(Random& random) {
  const auto family = familyNamed(
      random.oneOf({"generic", "near-plane", "depth-ratios", "depth-ties", "equal-depths", "close-depths", "views"}));
  Drawing drawing = family(random);
  drawing.list.depthTest =
      random.oneOf({raster::DepthTest::NearerOrEqual, raster::DepthTest::Farther, raster::DepthTest::FartherOrEqual});
  if (random.isOneIn(2)) punch(drawing, random);
  return drawing;
}

/// Other families in viewports that are no squares, with samples in the middle or at the corner of pixels.
Drawing viewports(Random& random) {
  const auto family = familyNamed(
      random.oneOf({"generic", "slivers", "sample-ties", "near-plane", "guard-band", "texel-borders", "facing"}));
  Drawing drawing = family(random);
  const auto place = random.oneOf({raster::SamplePlace::Middle, raster::SamplePlace::Corner});
  const int columns = random.between(1, 24);
  const raster::Viewport viewport{columns, random.between(1, 24)};
  for (raster::Face& face : drawing.faces) {
    face.viewport = viewport;
    face.sample = place;
    face.scissor = {0, 0, viewport.columns, viewport.rows};
  }
  return drawing;
}

/// Triangles in clip space: w of both signs and 0, z inside and outside of the range, on its planes and equal.
Drawing clipSpace(Random& random) {
  using namespace raster;
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  drawing.faces[0].nearDistance = 0x1p-20F;
  DrawList& list = drawing.list;
  list.clipDepth = random.oneOf({ClipDepth::ZeroToOne, ClipDepth::MinusOneToOne});
  list.depthTest =
      random.oneOf({DepthTest::Nearer, DepthTest::NearerOrEqual, DepthTest::Farther, DepthTest::FartherOrEqual});
  list.depthPrecision = random.oneOf({DepthPrecision::Exact, DepthPrecision::Exact, DepthPrecision::Unorm16,
                                      DepthPrecision::Unorm24, DepthPrecision::Float32});
  list.front = random.oneOf({Winding::CounterClockwise, Winding::Clockwise});
  const bool isOrthographic = random.isOneIn(3), hasSteps = random.isOneIn(3);
  const float size = random.oneOf({1.2F, 1.5F, 20.0F});
  for (int k = 0; k < 4; ++k) {
    add(drawing, random, cornersOf([&] {
          const float w = isOrthographic ? 1 : random.isOneIn(9) ? 0 : random.uniform(-0.6F, 3);
          const float x = random.uniform(-size, size), y = random.uniform(-size, size);
          const float z = hasSteps ? static_cast<float>(random.between(-8, 8)) / 8 : random.uniform(-1.1F, 1.1F);
          list.clipZ.push_back(random.isOneIn(9) ? 0 : z * (w == 0 ? 1 : w));
          return w == 0 ? glm::vec3(x, y, 0) : glm::vec3(x * std::abs(w), y * std::abs(w), w);
        }));
    list.draws.back().cull = random.oneOf({Cull::None, Cull::None, Cull::Front, Cull::Back});
  }
  if (random.isOneIn(2)) drawing.faces[0].y = -drawing.faces[0].y;
  return drawing;
}

/// Strips, fans and triangles of few vertices, some cut by restarts, with values of all kinds and instances.
Drawing assemblies(Random& random) {
  using namespace raster;
  Drawing drawing = random.isOneIn(2) ? clipSpace(random) : familyNamed("generic")(random);
  DrawList& list = drawing.list;
  list.value = random.oneOf({PixelValue::ItemIds, PixelValue::TriangleNumbers, PixelValue::VertexValues,
                             PixelValue::Pairs, PixelValue::PassedSamples});
  list.provoking = random.oneOf({Provoking::First, Provoking::Last});
  list.indexBits = random.oneOf({16, 32});
  if (list.value == PixelValue::VertexValues)
    for (std::size_t v = 0; v < list.positions.size(); ++v) list.vertexValues.push_back(random.below(100));
  for (ItemId i = 0; i < 3; ++i) {
    Instance instance;
    for (int axis = 0; axis < 3; ++axis) {
      instance.scale[axis] = random.oneOf({1.0F, -1.0F, 0.5F, 1.3F});
      instance.offset[axis] = random.uniform(-0.5F, 0.5F);
    }
    instance.id = 0x100 * (i + 1);
    list.instances.push_back(instance);
  }
  list.indices.clear();
  const std::uint32_t restart = list.indexBits == 16 ? 0xffff : 0xffffffff;
  const auto vertices = static_cast<std::uint32_t>(list.positions.size());
  for (Draw& draw : list.draws) {
    draw.topology = random.oneOf({Topology::Triangles, Topology::Strip, Topology::Fan});
    draw.restarts = random.isOneIn(2);
    draw.baseVertex = random.below(3);
    draw.instances = random.below(4);
    draw.firstInstance = random.below(4 - draw.instances);
    draw.first = static_cast<std::uint32_t>(list.indices.size());
    draw.count = 3 * (1 + random.below(2));
    if (list.value == PixelValue::Pairs) draw.back.reset();
    for (std::uint32_t k = 0; k < draw.count; ++k)
      list.indices.push_back(draw.restarts && random.isOneIn(5) ? restart : random.below(vertices - draw.baseVertex));
  }
  return drawing;
}

}  // namespace

const std::vector<RandomFamily>& newRandomFamilies() {
  static const std::vector<RandomFamily> families{
      {"holes", "holes that hide what is behind them, or that are filled", holes},
      {"culled-sides", "culled triangles that are drawn, and the wrong side culled", culledSides},
      {"two-sided", "a side in the place of its other side", twoSided},
      {"triangle-numbers", "numbers of other triangles or of another draw", triangleNumbers},
      {"depth-tests", "the order of depths, also of equal ones, and the depth clear", depthTests},
      {"viewports", "viewports that are no squares, and samples half a pixel off", viewports},
      {"clip-space", "clipping in clip space, depth ranges, reversed and stored depths, windings", clipSpace},
      {"assemblies", "strips, fans, restarts, instances, provoking vertices, pairs, counts", assemblies}};
  return families;
}

}  // namespace hemitex::reference
