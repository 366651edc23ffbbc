/// Parts of random drawings: points, triangles, index maps.
///
/// The operands of + and the arguments of a call have no defined order. So an expression draws at most one random
/// number, except in braces.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <utility>

#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/conformance/vectors/random.h"

namespace hemitex::reference {

inline constexpr int resolution = 16;

using Corners = std::array<glm::vec3, 3>;
using TexCoords = std::array<glm::vec2, 3>;

/// A point whose projection is (p.x, p.y) at depth p.z; exact if p.z is a power of two.
inline glm::vec3 seenAt(const glm::vec3& p) { return {p.x * p.z, p.y * p.z, p.z}; }

inline glm::vec3 anyPoint(Random& random) {
  return seenAt({random.uniform(-1.3f, 1.3f), random.uniform(-1.3f, 1.3f), random.uniform(0.5f, 4)});
}

/// Calls point() for each corner.
template <typename MakePoint>
Corners cornersOf(const MakePoint& point) {
  return {point(), point(), point()};
}

inline Corners anyCorners(Random& random) {
  return cornersOf([&] { return anyPoint(random); });
}

inline TexCoords anyTexCoords(Random& random, float low = -0.2f, float high = 1.2f) {
  TexCoords t;
  for (glm::vec2& p : t) p = {random.uniform(low, high), random.uniform(low, high)};
  return t;
}

inline raster::IndexMap anyCountingMap(Random& random) {
  const int width = random.between(1, 24);
  return countingMap(width, random.between(1, 24));
}

/// A front face and an index map, without triangles.
inline Drawing emptyDrawing(raster::IndexMap map) {
  Drawing drawing{plainList(), {frontFace(resolution)}};
  drawing.list.indexMaps.push_back(std::move(map));
  return drawing;
}

inline void append(raster::DrawList& list, const Corners& p, const TexCoords& t) {
  addTriangle(list, {p[0], p[1], p[2]}, {t[0], t[1], t[2]});
}

/// Adds a triangle as a draw of its own; every other one has a back item ID.
inline void add(Drawing& drawing, const Corners& p, const TexCoords& t) {
  const auto number = static_cast<raster::ItemId>(drawing.list.draws.size());
  addDraw(drawing.list, number << 16, number % 2 == 0 ? std::optional<raster::ItemId>() : 0xfffffffe, 0);
  append(drawing.list, p, t);
}

inline void add(Drawing& drawing, Random& random, const Corners& p) { add(drawing, p, anyTexCoords(random)); }

/// Four triangles with the corners that `corners()` gives.
template <typename MakeCorners>
void addFour(Drawing& drawing, Random& random, const MakeCorners& corners) {
  for (int k = 0; k < 4; ++k) add(drawing, random, corners());
}

/// The same on a map of any size.
template <typename MakeCorners>
Drawing ofFour(Random& random, const MakeCorners& corners) {
  Drawing drawing = emptyDrawing(anyCountingMap(random));
  addFour(drawing, random, corners);
  return drawing;
}

}  // namespace hemitex::reference
