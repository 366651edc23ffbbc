// The derivation in an explanation ends in the item ID of the renderer, and its numbers equal those of the stages.
#include "reference/conformance/verdict/explanation.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>
#include <numeric>

#include "raster/plain/plain_renderer.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/trace/stage_dump.h"
#include "reference/conformance/vectors/random_vectors.h"
#include "tests/support/raster_scenes.h"

using namespace hemitex;
using nlohmann::ordered_json;
using reference::TestVector;

namespace {

const TestVector& named(const std::vector<TestVector>& suite, const std::string& name) {
  const auto found = std::find_if(suite.begin(), suite.end(), [&](const TestVector& v) { return v.name == name; });
  REQUIRE(found != suite.end());
  return *found;
}

/// The derivation of a pixel in the viewport of a face; null for the background.
ordered_json derivationAt(const TestVector& vector, std::size_t face, int column, int row) {
  return reference::explanation(vector, vector.faces[face], column, row)["derivation"];
}

/// Calls check(pixel, derivation) for about `count` pixels of a face, spread over it.
template <typename Check>
void forSomePixels(const TestVector& vector, std::size_t face, int count, const Check& check) {
  const raster::Scissor& scissor = vector.faces[face].face.scissor;
  const int pixels = scissor.width * scissor.height;
  // Odd steps, so that columns differ from row to row.
  const int step = std::max(1, pixels / count) | 1;
  for (int pixel = step / 2; pixel < pixels; pixel += step)
    check(static_cast<std::size_t>(pixel),
          derivationAt(vector, face, scissor.column + pixel % scissor.width, scissor.row + pixel / scissor.width));
}

/// Number of pixels of each kind in a test.
struct Met {
  int cut = 0, backs = 0, mirrored = 0, clamped = 0, added = 0, replaced = 0, background = 0, onEdges = 0;
};

void count(const raster::DrawList& list, const raster::Face& face, const ordered_json& derivation, Met& met) {
  met.cut += !derivation["clip"]["cut_by"].empty();
  met.backs += derivation["faces_away"] && list.draws[derivation["draw"].get<std::size_t>()].back;
  met.mirrored += raster::determinant(face) < 0;
  if (!derivation["texel"].is_null()) {
    met.clamped += list.blend == raster::Blend::ClampedAdd;
    met.added += list.blend == raster::Blend::IntegerAdd;
    met.replaced += list.blend == raster::Blend::Replace;
  }
  met.onEdges += std::any_of(derivation["edges"].begin(), derivation["edges"].end(),
                             [](const ordered_json& edge) { return edge["value"] == 0; });
}

}  // namespace

TEST_CASE("An explanation ends in the item ID of the renderer for clipped, mirrored, back-facing and blended pixels",
          "[derivation]") {
  Met met;
  for (const TestVector& vector : reference::vectorSuite()) {
    const std::vector<raster::ItemBuffer> expected = reference::render(vector);
    for (std::size_t f = 0; f < vector.faces.size(); ++f) {
      const raster::Face& face = vector.faces[f].face;
      INFO(vector.name << ", " << vector.faces[f].name);
      int wrong = 0;
      forSomePixels(vector, f, 24, [&](std::size_t pixel, const ordered_json& derivation) {
        const raster::ItemId background = raster::backgroundId(vector.list.format);
        wrong +=
            (derivation.is_null() ? background : derivation["word"].get<raster::ItemId>()) != expected[f].ids[pixel];
        met.background += derivation.is_null();
        if (!derivation.is_null()) count(vector.list, face, derivation, met);
      });
      CHECK(wrong == 0);
    }
  }
  for (const int kind :
       {met.cut, met.backs, met.mirrored, met.clamped, met.added, met.replaced, met.background, met.onEdges})
    CHECK(kind > 20);
}

TEST_CASE("An explanation gives the numbers of stagesOf", "[derivation]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  for (const char* name : {"five-faces", "perspective-clipped", "perspective-twist", "frustum-sheet", "needles"}) {
    const TestVector& vector = named(suite, name);
    for (std::size_t f = 0; f < vector.faces.size(); ++f) {
      const reference::Stages stages = reference::stagesOf(vector.list, vector.faces[f].face);
      INFO(name << ", " << vector.faces[f].name);
      forSomePixels(vector, f, 60, [&](std::size_t pixel, const ordered_json& derivation) {
        REQUIRE(derivation.is_null() == (stages.triangles[pixel] < 0));
        if (derivation.is_null()) return;
        CHECK(derivation["triangle"] == stages.triangles[pixel]);
        const double inverseDepth = derivation["inverse_depth"];
        CHECK(std::abs(inverseDepth - stages.inverseDepths[pixel]) <= 0x1p-49 * inverseDepth);
        const glm::dvec2 coordinates(derivation["u"], derivation["v"]);
        const glm::dvec2 off = glm::abs(coordinates - stages.coordinates[pixel]);
        CHECK(std::max(off.x, off.y) <= 0x1p-49);  // no coordinate here exceeds 1
        const glm::ivec2 none(-1), texel = stages.texels[pixel];
        CHECK(derivation["texel"].is_null() == (texel == none));
        if (texel != none) CHECK(glm::ivec2(derivation["texel"]["column"], derivation["texel"]["row"]) == texel);

        std::int64_t edges = 0;
        for (const ordered_json& edge : derivation["edges"]) edges += edge["value"].get<std::int64_t>();
        CHECK(edges == std::abs(derivation["area"].get<std::int64_t>()));
        double weights = 0;
        for (const double weight : derivation["weights"]) weights += weight;
        CHECK(weights == Approx(1));
        std::array<glm::ivec2, 3> snapped;
        for (std::size_t k = 0; k < 3; ++k) {
          const ordered_json& corner = derivation["corners"][k]["snapped"];
          snapped[k] = {corner[0], corner[1]};
        }
        const auto isPiece = [&](std::size_t p) {
          return stages.pieceTriangles[p] == stages.triangles[pixel] && stages.pieceSnapped[p] == snapped;
        };
        std::vector<std::size_t> pieces(stages.pieceTriangles.size());
        std::iota(pieces.begin(), pieces.end(), std::size_t{0});
        if (derivation["clip"]["cut_by"].empty())
          for (std::size_t k = 0; k < 3; ++k)
            CHECK(snapped[k] == stages.snapped[derivation["vertices"][k]["index"].get<std::size_t>()]);
        else
          CHECK(std::any_of(pieces.begin(), pieces.end(), isPiece));
      });
    }
  }
}

TEST_CASE("An explanation finds the next triangle behind, by the exact difference of 1/w", "[derivation]") {
  const std::vector<TestVector> suite = reference::vectorSuite();
  // On the slope all triangles that cover a sample are equally near.
  const TestVector& slope = named(suite, "coplanar-slope");
  int ties = 0;
  forSomePixels(slope, 0, 200, [&](std::size_t, const ordered_json& derivation) {
    if (derivation.is_null() || derivation["runner_up"].is_null()) return;
    ++ties;
    CHECK(derivation["runner_up"]["difference"] == 0);
    CHECK(derivation["runner_up"]["draw"] > derivation["draw"]);
  });
  CHECK(ties > 20);
  // One pixel each: w and the next binary32 number (suite_depth.cpp).
  const TestVector& steps = named(suite, "depth-steps");
  for (int pixel = 0; pixel < 256; ++pixel) {
    const double w = std::ldexp(1 + pixel % 16 / 16.0, pixel / 16), step = std::ldexp(0x1p-23, pixel / 16);
    const ordered_json runnerUp = derivationAt(steps, 0, pixel % 16, pixel / 16)["runner_up"];
    REQUIRE(runnerUp.is_object());
    CHECK(runnerUp["difference"].get<double>() == Approx(step / w / (w + step)).epsilon(1e-12));
  }
  // A pixel that one triangle covers has none, though another comes close.
  raster::DrawList list = tests::plainList();
  tests::addDraw(list, 1);
  tests::addPixel(list, 4, 1, 2);
  tests::addPixel(list, 4, 2, 2);
  const TestVector alone = reference::makeVector("alone", "", list, {tests::frontFace(4)});
  REQUIRE(derivationAt(alone, 0, 1, 2).is_object());
  CHECK(derivationAt(alone, 0, 1, 2)["runner_up"].is_null());
  CHECK(derivationAt(alone, 0, 3, 2).is_null());
}

TEST_CASE("Explanations and stagesOf see through holes and culled triangles", "[trace]") {
  for (const reference::RandomFamily& family : reference::newRandomFamilies())
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      const TestVector vector = reference::randomVector(seed, family.name);
      const raster::Face& face = vector.faces[0].face;
      const std::vector<raster::ItemId> ids = reference::render(vector)[0].ids;
      const reference::Stages stages = reference::stagesOf(vector.list, face);
      bool areEqual = true;
      for (std::size_t p = 0; p < ids.size(); ++p) {
        const glm::ivec2 at = reference::pixelAt(face.scissor, p);
        const ordered_json derived = derivationAt(vector, 0, at.x, at.y);
        const bool isCovered = !derived.is_null();
        areEqual &= ids[p] == (isCovered ? derived["word"].get<raster::ItemId>() : raster::clearedValue(vector.list));
        areEqual &= stages.triangles[p] == (isCovered ? derived["triangle"].get<int>() : -1);
      }
      INFO(vector.name);
      CHECK(areEqual);
    }
}
