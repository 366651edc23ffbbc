/// Faults of what version 2 of the rules adds: assembly, values of pixels, clip space and stored depths.
#include <cmath>
#include <functional>

#include "raster/interface/assembly.h"
#include "raster/interface/depth_test.h"
#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::DrawList;
using raster::ItemId;
using raster::PixelValue;

/// A device that assembles a changed list.
Variant withSource(const std::string& name, const std::function<void(DrawList&)>& change) {
  return {name, withStage(&StagedDevice::assemble, [=](DrawList source) {
            change(source);
            return raster::assembled(source);
          })};
}

bool hasNumbers(const DrawList& source) {
  return source.value == PixelValue::TriangleNumbers || source.value == PixelValue::Pairs;
}

// --- primitive IDs ---

/// A list whose draws are single triangles. `idOf` gives the value of triangle t of draw d.
DrawList renumbered(const DrawList& list, const std::function<ItemId(std::size_t, std::uint32_t)>& idOf) {
  DrawList result = list;
  result.draws.clear();
  for (std::size_t d = 0; d < list.draws.size(); ++d)
    for (std::uint32_t t = 0; 3 * t < list.draws[d].count; ++t) {
      raster::Draw draw = list.draws[d];
      draw.first += 3 * t;
      draw.count = 3;
      draw.offset = idOf(d, t);
      result.draws.push_back(draw);
    }
  return result;
}

/// The value of a triangle of an assembled draw. Of pairs, only those of draws have a number.
ItemId numberIn(const DrawList& source, const raster::Draw& draw, std::uint32_t number) {
  const bool isPair = source.value != PixelValue::Pairs || 3 * number < draw.count;
  return isPair ? draw.offset + number : 0xfffffffe;
}

/// Triangle t of assembled draw d has the offset of another draw.
Variant withOffsetsOf(const std::string& name, std::size_t shift) {
  const auto assemble = [=](const DrawList& source) {
    const DrawList list = raster::assembled(source);
    return renumbered(list, [&](std::size_t d, std::uint32_t t) {
      return numberIn(source, list.draws[(d + shift) % list.draws.size()], t);
    });
  };
  return {name, withStage(&StagedDevice::assemble, assemble)};
}

/// Numbers count on from draw to draw.
Variant countingOn() {
  const auto assemble = [](const DrawList& source) {
    const DrawList list = raster::assembled(source);
    std::vector<std::uint32_t> before{0};
    for (const raster::Draw& draw : list.draws) before.push_back(before.back() + draw.count / 3);
    return renumbered(list,
                      [&](std::size_t d, std::uint32_t t) { return numberIn(source, list.draws[d], before[d] + t); });
  };
  return {"counted on from draw to draw", withStage(&StagedDevice::assemble, assemble)};
}

std::vector<Variant> otherDraws(const DrawList& source, std::size_t draws) {
  if (!hasNumbers(source) || draws < 2) return {};
  return {withOffsetsOf("of the next draw", 1), withOffsetsOf("of the draw before", draws - 1), countingOn()};
}

/// The numbers of a draw's triangles on a device that starts again after a restart, or that counts the entries of
/// indices as if nothing were cut off.
std::vector<std::uint32_t> numbersAfterRestarts(const DrawList& source, const raster::Draw& draw, bool startsAgain) {
  std::vector<std::uint32_t> numbers;
  std::uint32_t entries = 0, triangles = 0;  // since the last restart
  for (std::uint32_t k = draw.first; k < draw.first + draw.count; ++k) {
    if (source.indices[k] == raster::restartIndex(source)) {
      entries = triangles = 0;
      continue;
    }
    ++entries;
    const bool isList = draw.topology == raster::Topology::Triangles;
    if (entries < 3 || (isList && entries % 3 != 0)) continue;
    const std::uint32_t inRow = isList ? (k - draw.first) / 3 : k - draw.first - 2;
    numbers.push_back(startsAgain ? triangles++ : inRow);
  }
  return numbers;
}

/// For lists whose draws are not instanced.
Variant numberedAfterRestarts(const std::string& name, bool startsAgain) {
  const auto assemble = [=](const DrawList& source) {
    const DrawList list = raster::assembled(source);
    return renumbered(list, [&](std::size_t d, std::uint32_t t) {
      const raster::Draw& draw = source.draws[d];
      if (!draw.restarts) return list.draws[d].offset + t;
      return numberIn(source, list.draws[d], numbersAfterRestarts(source, draw, startsAgain)[t]);
    });
  };
  return {name, withStage(&StagedDevice::assemble, assemble)};
}

bool restarts(const DrawList& source) {
  return std::any_of(source.draws.begin(), source.draws.end(), [](const raster::Draw& draw) { return draw.restarts; });
}

std::vector<Variant> restartedNumbers(const DrawList& source) {
  if (!hasNumbers(source) || !restarts(source) || !source.instances.empty()) return {};
  return {numberedAfterRestarts("starts again at 0", true),
          numberedAfterRestarts("counts what a restart cuts off", false)};
}

// --- assembly ---

constexpr std::uint32_t wideRestart = 0xffffffff;

/// Indices of 32 bits that need no base vertex.
void widen(DrawList& list) {
  const std::uint32_t restart = raster::restartIndex(list);
  for (raster::Draw& draw : list.draws) {
    for (std::uint32_t k = draw.first; k < draw.first + draw.count; ++k) {
      const bool isRestart = draw.restarts && list.indices[k] == restart;
      list.indices[k] = isRestart ? wideRestart : list.indices[k] + draw.baseVertex;
    }
    draw.baseVertex = 0;
  }
  list.indexBits = 32;
}

std::vector<Variant> ignoredRestarts(const DrawList& source) {
  if (!restarts(source) || source.positions.empty()) return {};
  const auto takenAs = [](const std::string& name, std::uint32_t vertex) {
    return withSource(name, [=](DrawList& list) {
      widen(list);
      std::replace(list.indices.begin(), list.indices.end(), wideRestart, vertex);
      for (raster::Draw& draw : list.draws) {
        draw.restarts = false;
        if (draw.topology == raster::Topology::Triangles) draw.count -= draw.count % 3;
      }
    });
  };
  return {takenAs("taken as the last vertex", static_cast<std::uint32_t>(source.positions.size()) - 1),
          takenAs("taken as vertex 0", 0)};
}

std::vector<Variant> wrappedIndices(const DrawList& source) {
  const auto isMoved = [](const raster::Draw& draw) { return draw.baseVertex != 0; };
  if (std::none_of(source.draws.begin(), source.draws.end(), isMoved)) return {};
  return {withSource("16 bits",
                     [](DrawList& list) {
                       widen(list);
                       for (std::uint32_t& index : list.indices)
                         if (index != wideRestart) index &= 0xffff;
                     }),
          withSource("the base vertex left out", [](DrawList& list) {
            for (raster::Draw& draw : list.draws) draw.baseVertex = 0;
          })};
}

std::vector<Variant> otherInstances(const DrawList& source) {
  if (source.instances.empty()) return {};
  using Pick = std::function<std::size_t(std::size_t, std::size_t)>;  // of an instance, of their number
  const auto placedAt = [&](const std::string& name, const Pick& pick) {
    return withSource(name, [=](DrawList& list) {
      const std::vector<raster::Instance> right = list.instances;
      for (std::size_t i = 0; i < right.size(); ++i) {
        list.instances[i] = right[pick(i, right.size())];
        list.instances[i].id = right[i].id;
      }
    });
  };
  const auto numberedAs = [&](const std::string& name, const Pick& pick) {
    return withSource(name, [=](DrawList& list) {
      const std::vector<raster::Instance> right = list.instances;
      for (std::size_t i = 0; i < right.size(); ++i) list.instances[i].id = right[pick(i, right.size())].id;
    });
  };
  const Pick next = [](std::size_t i, std::size_t count) { return (i + 1) % count; };
  const Pick before = [](std::size_t i, std::size_t count) { return (i + count - 1) % count; };
  const Pick first = [](std::size_t, std::size_t) { return std::size_t{0}; };
  return {placedAt("placed as the next one", next),
          placedAt("placed as the one before", before),
          placedAt("all placed as the first", first),
          numberedAs("with the ID of the next one", next),
          numberedAs("with the ID of the one before", before),
          numberedAs("all with the ID of the first", first),
          withSource("the first instance of draws ignored", [](DrawList& list) {
            for (raster::Draw& draw : list.draws) draw.firstInstance = 0;
          })};
}

std::vector<Variant> otherProvokingVertices(const DrawList& source) {
  if (source.value != PixelValue::VertexValues) return {};
  return {withSource("", [](DrawList& list) {
    const bool isFirst = list.provoking == raster::Provoking::First;
    list.provoking = isFirst ? raster::Provoking::Last : raster::Provoking::First;
  })};
}

std::vector<Variant> oneWinding(const TestVector& vector) {
  const auto isFlipped = [](const VectorFace& face) { return raster::determinant(face.face) < 0; };
  if (vector.list.clipDepth == raster::ClipDepth::None ||
      std::none_of(vector.faces.begin(), vector.faces.end(), isFlipped))
    return {};
  return {turnedInMirroredViews("")};
}

// --- clip space and depths ---

/// The unrounded depth of the rules for a depth d from 0 to 1.
double depthOfCleared(const DrawList& list, double d) {
  const raster::DepthRule rule = raster::depthRuleOf(list, {});
  return list.depthPrecision == raster::DepthPrecision::Exact ? (d - rule.offset) / rule.scale : d;
}

std::vector<Variant> wrongClears(const DrawList& list) {
  if (list.clipDepth == raster::ClipDepth::None) return {};
  const bool isReversed = raster::keepsFarther(list.depthTest);
  return {{isReversed ? "cleared to 1" : "cleared to 0",
           withStage(&StagedDevice::clearedDepth, depthOfCleared(list, isReversed ? 1 : 0))}};
}

/// Triangles wholly behind the eye are projected through it.
std::vector<Variant> drawnBehind(const DrawList& list) {
  if (list.clipDepth == raster::ClipDepth::None) return {};
  StagedGeometry geometry;
  geometry.polygon = [](const raster::Face& face, const DrawList& drawn, std::uint32_t t) {
    std::array<raster::ViewVertex, 3> vertices = raster::view(face, drawn, t);
    const bool isBehind = std::all_of(vertices.begin(), vertices.end(), [](const auto& p) { return p.w < 0; });
    for (raster::ViewVertex& p : vertices)
      if (isBehind) p = {-p.x, -p.y, -p.w, p.u, p.v, -p.z};
    return raster::areFinite(vertices) ? raster::clip(vertices, face.nearDistance, drawn.clipDepth)
                                       : raster::ClippedPolygon{};
  };
  return {{"", withStage(&StagedDevice::geometry, geometry)}};
}

/// Snapped coordinates keep so many bits, as signed numbers.
std::vector<Variant> overflowingCoordinates(const DrawList& list) {
  if (list.clipDepth == raster::ClipDepth::None) return {};
  std::vector<Variant> variants;
  for (const int bits : {12, 13, 14, 15, 16}) {
    StagedGeometry geometry;
    geometry.snap = [=](double position) {
      const double range = std::ldexp(1, bits), whole = std::nearbyint(position);
      return whole - range * std::floor(whole / range + 0.5);
    };
    variants.push_back({std::to_string(bits) + " bits", withStage(&StagedDevice::geometry, geometry)});
  }
  return variants;
}

std::vector<Variant> countedQuads(const DrawList& list) {
  if (list.value != PixelValue::PassedSamples) return {};
  return {{"", withStage(&StagedDevice::countsQuads, true)}};
}

}  // namespace

std::vector<Fault> assemblyFaults(const TestVector& vector) {
  const DrawList& source = sourceOf(vector);
  std::vector<Fault> faults{
      {"primitive ID off by one draw", "triangles of each draw count from 0: look at the slot that the shader reads",
       otherDraws(source, vector.list.draws.size())},
      {"primitive ID wrong after a restart",
       "a restart does not end the count, and what it cuts off counts nothing: look at the driver",
       restartedNumbers(source)},
      {"restart ignored", "turn primitive restart on, with the largest index of the type", ignoredRestarts(source)},
      {"index wraps", "add the base vertex in 32 bits, not in the type of the indices", wrappedIndices(source)},
      {"wrong instance", "look at the first instance, and at the step of attributes per instance",
       otherInstances(source)},
      {"provoking vertex swapped", "look at the convention for flat attributes: first or last vertex",
       otherProvokingVertices(source)},
      {"winding flipped with y",
       "fronts are those of clip space: a flipped viewport reverses what the interface calls clockwise",
       oneWinding(vector)},
      {"depth cleared to the wrong end", "clear reversed depths to 0, and others to 1", wrongClears(source)},
      {"w < 0 drawn", "clip at w > 0 before the division: points behind the eye have no picture", drawnBehind(source)},
      {"guard band overflow", "clip at the guard band: coordinates beyond it overflow", overflowingCoordinates(source)},
      {"helper pixels counted", "count fragments that pass, not all pixels of the quads that derivatives need",
       countedQuads(source)}};
  std::erase_if(faults, [](const Fault& fault) { return fault.variants.empty(); });
  return faults;
}

}  // namespace hemitex::reference
