// A derivation ends in the item ID of the renderer, and its numbers equal those of the stages.
#include "reference/conformance/trace/pixel_trace.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <numeric>

#include "raster/plain/plain_renderer.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/trace/stage_dump.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using reference::Derivation;
using reference::TestVector;

namespace {

const TestVector& named(const std::vector<TestVector>& suite, const std::string& name) {
  const auto found = std::find_if(suite.begin(), suite.end(), [&](const TestVector& v) { return v.name == name; });
  REQUIRE(found != suite.end());
  return *found;
}

std::optional<Derivation> deriveAt(const raster::DrawList& list, const raster::Face& face,
                                   std::span<const raster::SnappedTriangle> triangles, int column, int row) {
  return reference::derive(list, face, reference::fragmentsAt(list, triangles, column, row), column, row);
}

std::optional<Derivation> deriveAt(const raster::DrawList& list, const raster::Face& face, int column, int row) {
  return deriveAt(list, face, raster::snappedTriangles(list, face), column, row);
}

/// Calls check(pixel, derivation) for about `count` pixels of a face, spread over it.
template <typename Check>
void forSomePixels(const raster::DrawList& list, const raster::Face& face, int count, const Check& check) {
  const auto triangles = raster::snappedTriangles(list, face);
  const int width = face.scissor.width, pixels = width * face.scissor.height;
  // Odd steps, so that columns differ from row to row.
  const int step = std::max(1, pixels / count) | 1;
  for (int pixel = step / 2; pixel < pixels; pixel += step)
    check(static_cast<std::size_t>(pixel),
          deriveAt(list, face, triangles, face.scissor.column + pixel % width, face.scissor.row + pixel / width));
}

/// Number of pixels of each kind in a test.
struct Met {
  int cut = 0, backs = 0, mirrored = 0, clamped = 0, added = 0, replaced = 0, background = 0, onEdges = 0;
};

void count(const raster::DrawList& list, const raster::Face& face, const Derivation& derivation, Met& met) {
  met.cut += !derivation.cutBy.empty();
  met.backs += derivation.visible.facesAway && list.draws[derivation.visible.draw].back;
  met.mirrored += raster::determinant(face) < 0;
  if (derivation.texel) {
    met.clamped += list.blend == raster::Blend::ClampedAdd;
    met.added += list.blend == raster::Blend::IntegerAdd;
    met.replaced += list.blend == raster::Blend::Replace;
  }
  met.onEdges += std::any_of(derivation.edges.begin(), derivation.edges.end(),
                             [](const reference::DerivedEdge& edge) { return edge.value == 0; });
}

}  // namespace

TEST_CASE("derive ends in the item ID of the renderer for clipped, mirrored, back-facing and blended pixels",
          "[derivation]") {
  Met met;
  for (const TestVector& vector : reference::vectorSuite()) {
    const std::vector<raster::ItemBuffer> expected = reference::render(vector);
    for (std::size_t f = 0; f < vector.faces.size(); ++f) {
      const raster::Face& face = vector.faces[f].face;
      INFO(vector.name << ", " << vector.faces[f].name);
      int wrong = 0;
      forSomePixels(vector.list, face, 64, [&](std::size_t pixel, const std::optional<Derivation>& derivation) {
        const raster::ItemId background = raster::backgroundId(vector.list.format);
        wrong += (derivation ? derivation->visible.id : background) != expected[f].ids[pixel];
        met.background += !derivation;
        if (derivation) count(vector.list, face, *derivation, met);
      });
      CHECK(wrong == 0);
    }
  }
  for (const int kind :
       {met.cut, met.backs, met.mirrored, met.clamped, met.added, met.replaced, met.background, met.onEdges})
    CHECK(kind > 20);
}

TEST_CASE("derive gives the numbers of stagesOf", "[derivation]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const char* name : {"five-faces", "perspective-clipped", "perspective-twist", "frustum-sheet", "needles"}) {
    const TestVector& vector = named(suite, name);
    for (const reference::VectorFace& face : vector.faces) {
      const reference::Stages stages = reference::stagesOf(vector.list, face.face);
      INFO(name << ", " << face.name);
      forSomePixels(vector.list, face.face, 200, [&](std::size_t pixel, const std::optional<Derivation>& derivation) {
        REQUIRE(derivation.has_value() == (stages.triangles[pixel] >= 0));
        if (!derivation) return;
        CHECK(static_cast<std::int32_t>(derivation->visible.triangle) == stages.triangles[pixel]);
        CHECK(std::abs(derivation->inverseDepth - stages.inverseDepths[pixel]) <= 0x1p-49 * derivation->inverseDepth);
        const glm::dvec2 off = glm::abs(derivation->coordinates - stages.coordinates[pixel]);
        CHECK(std::max(off.x, off.y) <= 0x1p-49);  // no coordinate here exceeds 1
        const glm::ivec2 none(-1), texel = stages.texels[pixel];
        CHECK(derivation->texel.has_value() == (texel != none));
        if (derivation->texel)
          CHECK(glm::ivec2(derivation->visible.texel->column, derivation->visible.texel->row) == texel);

        std::int64_t edges = 0;
        for (const reference::DerivedEdge& edge : derivation->edges) edges += edge.value;
        CHECK(edges == std::abs(derivation->area));
        CHECK(std::accumulate(derivation->weights.begin(), derivation->weights.end(), 0.0) == Approx(1));
        const auto isPiece = [&](std::size_t p) {
          return stages.pieceTriangles[p] == stages.triangles[pixel] &&
                 stages.pieceSnapped[p] == std::array<glm::ivec2, 3>{derivation->corners[0].snapped,
                                                                     derivation->corners[1].snapped,
                                                                     derivation->corners[2].snapped};
        };
        std::vector<std::size_t> pieces(stages.pieceTriangles.size());
        std::iota(pieces.begin(), pieces.end(), std::size_t{0});
        if (derivation->cutBy.empty())
          for (std::size_t k = 0; k < 3; ++k)
            CHECK(derivation->corners[k].snapped == stages.snapped[derivation->vertices[k].index]);
        else
          CHECK(std::any_of(pieces.begin(), pieces.end(), isPiece));
      });
    }
  }
}

TEST_CASE("derive finds the next triangle behind, by the exact difference of 1/w", "[derivation]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  // On the slope all triangles that cover a sample are equally near.
  const TestVector& slope = named(suite, "coplanar-slope");
  int ties = 0;
  forSomePixels(slope.list, slope.faces[0].face, 200, [&](std::size_t, const std::optional<Derivation>& derivation) {
    if (!derivation || !derivation->runnerUp) return;
    ++ties;
    CHECK(derivation->runnerUp->difference == 0);
    CHECK(derivation->runnerUp->drawn.draw > derivation->visible.draw);
  });
  CHECK(ties > 20);
  // One pixel each: w and the next binary32 number (suite_depth.cpp).
  const TestVector& steps = named(suite, "depth-steps");
  for (int pixel = 0; pixel < 256; ++pixel) {
    const double w = std::ldexp(1 + pixel % 16 / 16.0, pixel / 16), step = std::ldexp(0x1p-23, pixel / 16);
    const auto derivation = deriveAt(steps.list, steps.faces[0].face, pixel % 16, pixel / 16);
    REQUIRE(derivation);
    REQUIRE(derivation->runnerUp);
    CHECK(derivation->runnerUp->difference == Approx(step / w / (w + step)).epsilon(1e-12));
  }
  // A pixel that one triangle covers has none, though another comes close.
  raster::DrawList list = tests::plainList();
  tests::addDraw(list, 1);
  tests::addPixel(list, 4, 1, 2);
  tests::addPixel(list, 4, 2, 2);
  const auto derivation = deriveAt(list, tests::frontFace(4), 1, 2);
  REQUIRE(derivation);
  CHECK_FALSE(derivation->runnerUp);
  CHECK_FALSE(deriveAt(list, tests::frontFace(4), 3, 2));
}

TEST_CASE("derive and stagesOf see through holes and culled triangles", "[trace]") {
  for (const reference::RandomFamily& family : reference::newRandomFamilies())
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const TestVector vector = reference::randomVector(seed, family.name);
      const raster::Face& face = vector.faces[0].face;
      const std::vector<raster::ItemId> ids = reference::render(vector)[0].ids;
      const reference::Stages stages = reference::stagesOf(vector.list, face);
      bool areEqual = true;
      for (std::size_t p = 0; p < ids.size(); ++p) {
        const glm::ivec2 at = reference::pixelAt(face.scissor, p);
        const std::optional<Derivation> derived = deriveAt(vector.list, face, at.x, at.y);
        areEqual &= ids[p] == (derived ? derived->visible.id : raster::clearedValue(vector.list));
        areEqual &= stages.triangles[p] == (derived ? static_cast<int>(derived->visible.triangle) : -1);
      }
      INFO(vector.name);
      CHECK(areEqual);
    }
}
