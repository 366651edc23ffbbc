#include "reference/conformance/vectors/random_vectors.h"

#include <algorithm>
#include <array>
#include <utility>

#include "raster/base/input_error.h"
#include "reference/conformance/vectors/colour_channels.h"
#include "reference/conformance/vectors/random_drawings.h"

namespace hemitex::reference {
namespace {

using raster::ItemId;

// --- coverage and clipping ---

Drawing generic(Random& random) {
  return ofFour(random, [&] { return anyCorners(random); });
}

/// Triangles whose height is down to 1e-7 of their length.
Drawing slivers(Random& random) {
  return ofFour(random, [&]() -> Corners {
    const glm::vec3 a = anyPoint(random), b = anyPoint(random);
    const float height = random.oneOf({1e-1f, 1e-3f, 1e-5f, 1e-7f});
    const float t = random.uniform(0, 1);
    return {a, b, a + t * (b - a) + height * anyPoint(random)};
  });
}

/// Corners on samples, on half sub-pixels (where snapping rounds to even) and on sub-pixels; edges through samples,
/// some of them along pixel rows.
Drawing sampleTies(Random& random) {
  return ofFour(random, [&] {
    const int steps = random.oneOf({16, 32, 4096, 8192});  // per unit of the picture
    // Devices may clip at the sides of the view. Then they move edges, and only triangles inside of it have exact ties.
    const int range = random.oneOf({9, 13}) * steps / 10;
    const auto grid = [&] { return static_cast<float>(random.between(-range, range)) / static_cast<float>(steps); };
    float y = grid();
    return cornersOf([&] {
      const float x = grid();
      if (!random.isOneIn(3)) y = grid();
      return seenAt({x, y, random.oneOf({0.5f, 1.0f, 2.0f})});
    });
  });
}

/// Corners in front of, on and behind the near plane.
Drawing nearPlane(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  drawing.faces[0].nearDistance = 0.25f;
  const auto point = [&] {
    glm::vec3 corner{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-1, 2)};
    if (random.isOneIn(8)) corner.z = drawing.faces[0].nearDistance;
    return corner;
  };
  addFour(drawing, random, [&] { return cornersOf(point); });
  return drawing;
}

/// Triangles that extend far beyond the guard band.
Drawing guardBand(Random& random) {
  const auto point = [&] {
    const float size = random.oneOf({1.0f, 30.0f, 1000.0f});
    glm::vec3 corner = seenAt({random.uniform(-size, size), random.uniform(-size, size), random.uniform(0.1f, 3)});
    if (random.isOneIn(6)) corner.x = random.oneOf({-8.0f, 8.0f}) * corner.z;
    return corner;
  };
  return ofFour(random, [&] { return cornersOf(point); });
}

/// The generic drawing a million units away, where binary32 positions have a resolution of a sixteenth of a unit.
Drawing farFromZero(Random& random) {
  Drawing drawing = generic(random);
  const glm::vec3 away(1e6f, -1e6f, 1e6f);
  drawing.faces[0].eye = away;
  for (glm::vec3& position : drawing.list.positions) position += away;
  return drawing;
}

/// Pairs of triangles on both sides of an edge that runs from sample to sample across the whole view and beyond, inside
/// the guard band. It passes through every third sample of its way. Cut at a side of the view and snapped, it misses
/// them.
Drawing longEdges(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  for (int k = 0; k < 3; ++k) {
    const int thirds = random.between(15, 36), first = -random.between(12, 50), slope = random.oneOf({-1, 1});
    const int row = random.between(0, resolution - 1) + slope * (first - resolution / 2) / 3;
    const double w = random.oneOf({0.5, 1.0, 2.0});
    const bool isSteep = random.isOneIn(2);
    const auto point = [&](int along, int across) {
      const glm::dvec2 pixel(along + 0.5, across + 0.5);
      return Picture(resolution).point(isSteep ? glm::dvec2(pixel.y, pixel.x) : pixel, w);
    };
    const glm::vec3 start = point(first, row), end = point(first + 3 * thirds, row + slope * thirds);
    const int middle = first + 3 * thirds / 2, distance = random.between(10, 30);
    for (const int side : {-1, 1})
      add(drawing, random, {start, end, point(middle, row + slope * thirds / 2 + side * distance)});
  }
  return drawing;
}

// --- depth ---

/// Depths that differ by a factor of a million.
Drawing depthRatios(Random& random) {
  const auto point = [&] {
    return seenAt({random.uniform(-1.3f, 1.3f), random.uniform(-1.3f, 1.3f), random.oneOf({1e-2f, 1e4f})});
  };
  return ofFour(random, [&] { return cornersOf(point); });
}

/// Overlapping triangles of one plane, in random order; some have exact ties everywhere.
Drawing depthTies(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  const float slope = random.oneOf({0.0f, 0.25f, 0.3f});
  const auto point = [&] {
    const float x = static_cast<float>(random.between(-20, 20)) / 8;
    return glm::vec3(x, static_cast<float>(random.between(-20, 20)) / 8, 1.5f + slope * x);
  };
  addFour(drawing, random, [&] { return cornersOf(point); });
  return drawing;
}

/// Pairs of triangles with the same corners in the same order, in random order of all triangles.
Drawing equalDepths(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  const std::array<Corners, 3> corners{anyCorners(random), anyCorners(random), anyCorners(random)};
  std::array<std::size_t, 6> order{0, 1, 2, 0, 1, 2};
  for (std::uint32_t k = 5; k > 0; --k) std::swap(order[k], order[random.below(k + 1)]);
  for (const std::size_t k : order) add(drawing, random, corners[k]);
  return drawing;
}

/// Overlapping triangles in parallel planes whose distances are 2^-10 to 2^-18 of their depth.
Drawing closeDepths(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  drawing.faces[0].nearDistance = 1;
  addFour(drawing, random, [&] {
    const int steps = random.between(0, 7);
    const float depth = 2 + static_cast<float>(steps) / static_cast<float>(1 << random.between(9, 17));
    return cornersOf([&] { return seenAt({random.uniform(-2, 2), random.uniform(-2, 2), depth}); });
  });
  return drawing;
}

// --- texels ---

/// Walls seen straight on with texel borders through samples: exactly if the map has 16 texels along a side, to
/// binary32 precision if it has 19.
Drawing texelBorders(Random& random) {
  const int size = random.oneOf({16, 19});
  Drawing drawing = emptyDrawing(countingMap(size, size));
  const float w = random.oneOf({0.5f, 1.0f, 4.0f});
  // u = (i + c)/size at the sample of column i, with c a multiple of 1/2: either all samples are on a border, or none.
  const auto coordinate = [size](float x, int shift) {
    return static_cast<float>((static_cast<double>(x) * 8 + 8 - 0.5 + shift * 0.5) / size);
  };
  const int shiftU = random.between(0, 7), shiftV = random.between(0, 7);
  Corners p;
  TexCoords t;
  for (std::size_t k = 0; k < 3; ++k) {
    const float x = static_cast<float>(random.between(-8, 8)) / 4;
    const float y = static_cast<float>(random.between(-8, 8)) / 4;
    p[k] = seenAt({x, y, w});
    t[k] = {coordinate(x, shiftU), coordinate(y, shiftV)};
  }
  add(drawing, p, t);
  return drawing;
}

/// Maps with several texels per pixel, and coordinates up to twice the map's size outside of it.
Drawing minifiedMaps(Random& random) {
  const int width = random.between(20, 64);
  Drawing drawing = emptyDrawing(countingMap(width, random.between(20, 64)));
  for (int k = 0; k < 4; ++k) {
    const Corners p = anyCorners(random);
    add(drawing, p, anyTexCoords(random, -2, 3));
  }
  return drawing;
}

/// Triangles of constant coordinates on the border of a texel. Coordinates are multiples of 1/16 and depths powers of
/// two, so that double precision interpolates without rounding.
Drawing constantCoordinates(Random& random) {
  Drawing drawing = emptyDrawing(countingMap(16, 16));
  for (int k = 0; k < 4; ++k) {
    const Corners p = cornersOf([&] {
      const int x = random.between(-16, 16), y = random.between(-16, 16);
      return seenAt({static_cast<float>(x) / 16, static_cast<float>(y) / 16, random.oneOf({0.5f, 1.0f, 2.0f, 4.0f})});
    });
    const float u = static_cast<float>(random.between(1, 15)) / 16;
    const glm::vec2 t(u, static_cast<float>(random.between(1, 15)) / 16);
    add(drawing, p, {t, t, t});
  }
  return drawing;
}

/// Maps of 2000 to 4000 texels along u or v.
Drawing fineCoordinates(Random& random) {
  const int size = random.between(2000, 4000);
  Drawing drawing = emptyDrawing(random.isOneIn(2) ? countingMap(size, 1) : countingMap(1, size));
  addFour(drawing, random, [&] { return anyCorners(random); });
  return drawing;
}

// --- facing, views, vertices ---

/// Both windings with and without index map and back item ID, in a plain and a mirrored view.
Drawing facing(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  for (ItemId number = 0; number < 6; ++number) {
    const std::optional<ItemId> back = random.isOneIn(2) ? std::optional<ItemId>(0xfffffffe - number) : std::nullopt;
    addDraw(drawing.list, number << 16, back, random.isOneIn(2) ? std::optional<int>(0) : std::nullopt);
    const Corners p = anyCorners(random);
    append(drawing.list, p, anyTexCoords(random));
  }
  drawing.faces.push_back(drawing.faces[0]);
  drawing.faces[1].x = -drawing.faces[1].x;
  return drawing;
}

/// A scissor rectangle of at least 5 x 5 pixels.
raster::Scissor anyScissor(Random& random) {
  raster::Scissor scissor;
  scissor.width = random.between(5, resolution);
  scissor.height = random.between(5, resolution);
  scissor.column = random.between(0, resolution - scissor.width);
  scissor.row = random.between(0, resolution - scissor.height);
  return scissor;
}

/// A view along a coordinate axis, plain or mirrored, from an eye near the origin.
raster::Face anyFace(Random& random) {
  raster::Face face = frontFace(resolution, 0.125f);
  std::array<glm::vec3*, 3> rows{&face.x, &face.y, &face.w};
  const int first = random.between(0, 2), step = random.between(1, 2);
  for (int k = 0; k < 3; ++k) {
    glm::vec3& row = *rows[static_cast<std::size_t>(k)];
    row = {0, 0, 0};
    row[(first + k * step) % 3] = random.oneOf({-1.0f, 1.0f});
  }
  face.x *= random.oneOf({0.5f, 1.0f, 2.0f});
  face.eye = {random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
  face.scissor = anyScissor(random);
  return face;
}

/// Three views with eyes and scissor rectangles of their own, between triangles on all sides.
Drawing views(Random& random) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  drawing.faces = {anyFace(random), anyFace(random), anyFace(random)};
  const auto point = [&] { return glm::vec3{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-4, 4)}; };
  for (int k = 0; k < 8; ++k) add(drawing, random, cornersOf(point));
  return drawing;
}

/// Six triangles, each a draw of its own, between `count` vertices; `corners()` gives the three of a triangle.
template <typename MakeCorners>
Drawing ofVertices(Random& random, int count, const MakeCorners& corners) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  raster::DrawList& list = drawing.list;
  for (int k = 0; k < count; ++k) {
    list.positions.push_back(anyPoint(random));
    list.texcoords.push_back({random.uniform(-0.2f, 1.2f), random.uniform(-0.2f, 1.2f)});
  }
  for (ItemId number = 0; number < 6; ++number) {
    addDraw(list, number << 16, {}, 0);
    for (const std::uint32_t corner : corners()) list.indices.push_back(corner);
    list.draws.back().count = 3;
  }
  return drawing;
}

/// Triangles of six vertices that they share.
Drawing sharedVertices(Random& random) {
  return ofVertices(random, 6, [&]() -> std::array<std::uint32_t, 3> {
    const std::uint32_t a = random.below(6), b = (a + 1 + random.below(2)) % 6;
    return {a, b, (a + 3 + random.below(3)) % 6};
  });
}

/// Triangles with any of 320 vertices, most of which no triangle uses.
Drawing manyVertices(Random& random) {
  return ofVertices(random, 320, [&]() -> std::array<std::uint32_t, 3> {
    return {random.below(320), random.below(320), random.below(320)};
  });
}

// --- item IDs ---

raster::IdFormat anyFormat(Random& random) {
  const std::vector<std::string> names = raster::formatNames();
  const std::uint32_t k = random.below(static_cast<std::uint32_t>(names.size()) + 1);
  return k < names.size() ? *raster::formatNamed(names[k]) : raster::IdFormat{{3, 1, 7, 2}};
}

/// Random bits; or a number next to a power of two, where rounding and signs show.
ItemId anyId(Random& random, const raster::IdFormat& format) {
  const auto bits = static_cast<std::uint32_t>(raster::idBits(format));
  ItemId id = random.bits();
  if (random.isOneIn(2)) {
    id = ItemId{1} << random.below(bits);
    id += random.below(3) - 1;
  }
  return id & raster::backgroundId(format);
}

/// Six overlapping triangles in a scissor rectangle, some of them without index map or with a back item ID.
/// `texel` and `offset` give item IDs of the format.
template <typename MakeTexel, typename MakeOffset>
Drawing idDrawing(Random& random, const raster::IdFormat& format, raster::Blend operation, const MakeTexel& texel,
                  const MakeOffset& offset) {
  raster::IndexMap map = countingMap(7, 5);
  for (ItemId& id : map.ids) id = texel();
  Drawing drawing = emptyDrawing(std::move(map));
  drawing.list.format = format;
  drawing.list.blend = operation;
  drawing.faces[0].scissor = anyScissor(random);
  for (int k = 0; k < 6; ++k) {
    const std::optional<int> indexMap = random.isOneIn(4) ? std::nullopt : std::optional<int>(0);
    const ItemId front = offset(drawing.list.indexMaps[0]);
    addDraw(drawing.list, front, random.isOneIn(2) ? std::optional(raster::backId(format)) : std::nullopt, indexMap);
    const Corners p = anyCorners(random);
    append(drawing.list, p, anyTexCoords(random));
  }
  return drawing;
}

/// Sums that overflow channels. In the channel `kept` both terms lack the top bit, so that no sum is the background.
Drawing channelSums(Random& random) {
  const raster::IdFormat format = anyFormat(random);
  const auto channels = static_cast<std::uint32_t>(format.channelBits.size());
  std::size_t kept = random.below(channels);
  while (format.channelBits[kept] < 2) kept = random.below(channels);
  const int topBit = channelsOf(format)[kept].shift + format.channelBits[kept] - 1;
  const auto id = [&] { return anyId(random, format) & ~(ItemId{1} << topBit); };
  return idDrawing(random, format, raster::Blend::ClampedAdd, id, [&](const raster::IndexMap&) { return id(); });
}

/// Sums of whole item IDs with carries between channels and beyond the last one.
Drawing integerSums(Random& random) {
  const raster::IdFormat format = anyFormat(random);
  const ItemId all = raster::backgroundId(format);
  const auto offset = [&](const raster::IndexMap& map) {
    ItemId id = anyId(random, format);
    const auto isBackground = [&](ItemId texel) { return ((id + texel) & all) == all; };
    while (id == all || std::any_of(map.ids.begin(), map.ids.end(), isBackground)) id = (id + 1) & all;
    return id;
  };
  return idDrawing(
      random, format, raster::Blend::IntegerAdd, [&] { return anyId(random, format); }, offset);
}

/// Texels that replace offsets.
Drawing replacedIds(Random& random) {
  const raster::IdFormat format = anyFormat(random);
  const auto id = [&] { return std::min(anyId(random, format), raster::backId(format)); };
  return idDrawing(random, format, raster::Blend::Replace, id, [&](const raster::IndexMap&) { return id(); });
}

/// Aligned item IDs: the low bits hold the element of a map with fewer elements than they count.
Drawing alignedIds(Random& random) {
  const raster::IdFormat format = *raster::formatNamed(raster::formatNames()[1 + random.below(3)]);
  ItemId texel = 0;
  const auto offset = [&](const raster::IndexMap&) { return random.below(1u << 15) << 8; };
  return idDrawing(
      random, format, raster::Blend::ClampedAdd, [&] { return texel++; }, offset);
}

TestVector makeRandom(std::uint64_t seed, const RandomFamily& family) {
  Random random(seed);
  Drawing drawing = family.make(random);
  return makeVector(family.name + ("-" + std::to_string(seed)), family.catches, std::move(drawing.list),
                    std::move(drawing.faces));
}

}  // namespace

const std::vector<RandomFamily>& randomFamilies() {
  static const std::vector<RandomFamily> families{
      {"generic", "any systematic fault of views, coverage, texels and item IDs", generic},
      {"slivers", "coverage of triangles far narrower than a pixel", slivers},
      {"sample-ties", "the fill rule at samples on edges and corners, and the rounding of snapping", sampleTies},
      {"near-plane", "clipping at the near plane", nearPlane},
      {"guard-band", "clipping at the guard band", guardBand},
      {"far-from-zero", "an eye that is subtracted after rotation instead of before, far from zero", farFromZero},
      {"depth-ratios", "interpolation between depths that differ by a factor of a million", depthRatios},
      {"depth-ties", "the order of triangles at equal depths", depthTies},
      {"close-depths", "depths with too few bits", closeDepths},
      {"texel-borders", "samples on the borders of texels", texelBorders},
      {"minified-maps", "filters, mipmaps and wrap modes of index maps", minifiedMaps},
      {"facing", "facing in plain and mirrored views, backs with and without texels", facing},
      {"views", "views, scissor rectangles and eyes of several faces", views},
      {"shared-vertices", "offsets that vertices hold instead of draws", sharedVertices},
      {"channel-sums", "carries between channels, lost bits, conversions of colours", channelSums},
      {"integer-sums", "clamping or lost carries of an integer add", integerSums},
      {"replaced-ids", "modulate or add where the texel replaces the offset", replacedIds},
      {"aligned-ids", "offsets that are not aligned", alignedIds},
      {"equal-depths", "triangles with the same corners: the first one stays", equalDepths},
      {"many-vertices", "indices cut to 8 bits", manyVertices},
      {"long-edges", "triangles cut at the sides of the view", longEdges},
      {"constant-coordinates", "coordinates that are equal at all corners and rounded in between", constantCoordinates},
      {"fine-coordinates", "texture coordinates with too few bits", fineCoordinates}};
  return families;
}

TestVector randomVector(std::uint64_t seed, const std::string& family) {
  std::string names;
  for (const auto& families : {randomFamilies(), newRandomFamilies()})
    for (const RandomFamily& each : families) {
      if (each.name == family) return makeRandom(seed, each);
      names += (names.empty() ? "" : ", ") + std::string(each.name);
    }
  throw raster::InputError("no family of random vectors is named \"" + family + "\"", "use one of " + names);
}

TestVector interleavedRandomVector(std::uint64_t seed, std::uint64_t index) {
  const std::vector<RandomFamily>& families = randomFamilies();
  return makeRandom(seed + index / families.size(), families[index % families.size()]);
}

}  // namespace hemitex::reference
