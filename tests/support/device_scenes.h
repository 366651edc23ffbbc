/// Scenes for tests of real devices, and the tally of their verdicts.
#pragma once

#include <algorithm>
#include <limits>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "reference/conformance/verdict/verdict.h"
#include "tests/support/raster_scenes.h"

namespace hemitex::tests {

/// The vector of this name in the suite.
inline reference::TestVector suiteVector(const std::string& name) {
  for (const reference::TestVector& vector : reference::vectorSuite())
    if (vector.name == name) return vector;
  throw std::invalid_argument("the suite has no vector " + name);
}

/// The list without some of its triangles.
inline raster::DrawList without(const raster::DrawList& list, std::span<const std::uint32_t> skipped) {
  raster::DrawList rest = list;
  rest.indices.clear();
  for (raster::Draw& draw : rest.draws) {
    const auto first = static_cast<std::uint32_t>(rest.indices.size());
    for (std::uint32_t i = draw.first; i < draw.first + draw.count; ++i)
      if (!std::binary_search(skipped.begin(), skipped.end(), i / 3)) rest.indices.push_back(list.indices[i]);
    draw.first = first;
    draw.count = static_cast<std::uint32_t>(rest.indices.size()) - first;
  }
  return rest;
}

/// Walls with a value that is not finite, then one that fills the view of scaledFrontFace.
inline raster::DrawList wallsWithoutFiniteValues() {
  constexpr float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  raster::DrawList list = plainList();
  list.indexMaps.push_back(countingMap(4, 4));
  const auto addWall = [&](float depth, const glm::vec3& corner, const glm::vec2& texcoord) {
    addDraw(list, static_cast<raster::ItemId>(list.draws.size()) << 8, {}, 0);
    addTriangle(list, {{-3 * depth, -3 * depth, depth}, {9 * depth, -3 * depth, depth}, corner},
                {{0, 0}, {1, 0}, texcoord});
  };
  for (const float value : {infinity, -infinity, nan}) {
    addWall(1, {value, 9, 1}, {0, 1});
    addWall(1, {-3, 9, value}, {0, 1});
    addWall(1, {-3, 9, 1}, {value, 1});
    addWall(1, {-3, 9, 1}, {0, value});
  }
  addWall(1, {3e38f, 9, 1}, {0, 1});  // finite, but twice the value is not
  addWall(1, {-3, 9, 3e38f}, {0, 1});
  addWall(2, {-6, 18, 2}, {0, 1});
  return list;
}

/// A face of 16 x 16 pixels that doubles all coordinates.
inline raster::Face scaledFrontFace() {
  raster::Face face = frontFace(16);
  face.x.x = face.y.y = face.w.z = 2;
  return face;
}

/// Vectors of version 2 of the rules: its suite, and random ones of each of its families.
inline std::vector<reference::TestVector> version2Vectors(std::uint64_t perFamily) {
  std::vector<reference::TestVector> vectors = reference::drawVectors();
  for (const reference::RandomFamily& family : reference::newRandomFamilies())
    for (std::uint64_t seed = 0; seed < perFamily; ++seed)
      vectors.push_back(reference::randomVector(seed, family.name));
  return vectors;
}

/// Pixels that are not background by the rules or on the device, and how many of them are exact.
struct Tally {
  std::uint64_t covered = 0, exact = 0;

  void operator+=(const Tally& more) {
    covered += more.covered;
    exact += more.exact;
  }
};

inline Tally tallyOf(const reference::TestVector& vector, const reference::Verdict& verdict) {
  const raster::ItemId background = raster::backgroundId(vector.list.format);
  Tally tally;
  for (const reference::FaceVerdict& face : verdict.faces)
    for (std::size_t p = 0; p < face.pixels.size(); ++p) {
      if (face.expected.ids[p] == background && face.found.ids[p] == background) continue;
      ++tally.covered;
      tally.exact += face.pixels[p] == reference::PixelVerdict::Exact;
    }
  return tally;
}

}  // namespace hemitex::tests
