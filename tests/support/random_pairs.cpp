#include "tests/support/random_pairs.h"

#include <utility>

#include "reference/conformance/vectors/draw_list_builder.h"
#include "reference/conformance/vectors/random_vectors.h"

namespace hemitex::tests {
namespace {

using reference::Random;

constexpr std::uint32_t drawsPerPair = 5;

/// A point on the sub-pixels of a face of 16 x 16 pixels, at depth `unit` or 3 `unit`. The middle of two such points
/// projects to a sub-pixel, too: halfway between theirs, or a quarter of the way.
glm::vec3 latticePoint(Random& random, float unit) {
  const float x = static_cast<float>(random.between(-320, 320)) / 256;
  const float y = static_cast<float>(random.between(-320, 320)) / 256;
  const float w = random.oneOf({1.0f, 3.0f}) * unit;
  return {x * w, y * w, w};
}

/// Pairs of textured triangles with back item IDs. Draw k has depths from 4^k to 3 4^k, which no other draw has.
/// Nothing is clipped, and snapping moves nothing.
raster::DrawList latticeList(Random& random) {
  raster::DrawList list = reference::plainList();
  list.indexMaps.push_back(reference::countingMap(19, 13));
  for (std::uint32_t k = 0; k < drawsPerPair; ++k) {
    reference::addDraw(list, k << 16, random.isOneIn(2) ? std::optional<raster::ItemId>(0xfffffffe) : std::nullopt, 0);
    for (int vertex = 0; vertex < 6; ++vertex) {
      list.indices.push_back(static_cast<std::uint32_t>(list.positions.size()));
      list.positions.push_back(latticePoint(random, static_cast<float>(1u << 2 * k)));
      const float u = static_cast<float>(random.between(-16, 80)) / 64;
      list.texcoords.push_back({u, static_cast<float>(random.between(-16, 80)) / 64});
    }
    list.draws.back().count = 6;
  }
  return list;
}

void shuffle(std::vector<raster::Draw>& draws, Random& random) {
  for (std::uint32_t k = 1; k < draws.size(); ++k) std::swap(draws[k], draws[random.below(k + 1)]);
}

/// Moves by whole numbers, so that positions of the lattice move exactly.
void translate(TestVector& vector, Random& random) {
  const auto distance = [&] { return static_cast<float>(random.between(1, 1000)); };
  const glm::vec3 way{distance(), distance(), distance()};
  for (glm::vec3& position : vector.list.positions) position += way;
  vector.faces[0].face.eye += way;
}

/// Triangle (a, b, c) becomes (a, m, c), and (m, b, c) follows it.
void splitTriangle(TestVector& vector, Random& random) {
  raster::DrawList& list = vector.list;
  const std::uint32_t first = 3 * random.below(static_cast<std::uint32_t>(list.indices.size()) / 3);
  const std::uint32_t a = list.indices[first], b = list.indices[first + 1], c = list.indices[first + 2];
  const auto middle = static_cast<std::uint32_t>(list.positions.size());
  list.positions.push_back(0.5f * (list.positions[a] + list.positions[b]));
  list.texcoords.push_back(0.5f * (list.texcoords[a] + list.texcoords[b]));
  list.indices[first + 1] = middle;
  list.indices.insert(list.indices.begin() + first + 3, {middle, b, c});
  for (raster::Draw& draw : list.draws) {
    if (draw.first > first)
      draw.first += 3;
    else if (first < draw.first + draw.count)
      draw.count += 3;
  }
}

void permuteDraws(TestVector& vector, Random& random) {
  std::vector<raster::Draw>& draws = vector.list.draws;
  const std::uint32_t first = draws[0].first;
  while (draws[0].first == first) shuffle(draws, random);
}

void splitDraw(TestVector& vector, Random& random) {
  std::vector<raster::Draw>& draws = vector.list.draws;
  const std::uint32_t k = random.below(drawsPerPair);
  raster::Draw second = draws[k];
  second.first += 3;
  second.count -= 3;
  draws[k].count = 3;
  draws.insert(draws.begin() + k + 1, second);
}

}  // namespace

VectorPair randomPair(std::uint64_t seed, Relation relation) {
  Random random(seed);
  VectorPair pair{
      reference::makeVector("first-" + std::to_string(seed), {}, latticeList(random), {reference::frontFace(16)}), {}};
  shuffle(pair.first.list.draws, random);
  pair.second = pair.first;
  pair.second.name = "second-" + std::to_string(seed);
  switch (relation) {
    case Relation::TranslatedEye:
      translate(pair.second, random);
      break;
    case Relation::SplitTriangle:
      splitTriangle(pair.second, random);
      break;
    case Relation::PermutedDraws:
      permuteDraws(pair.second, random);
      break;
    case Relation::SplitDraw:
      splitDraw(pair.second, random);
      break;
  }
  return pair;
}

}  // namespace hemitex::tests
