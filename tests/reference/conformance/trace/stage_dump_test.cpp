// The stages of a face equal the fragments at each pixel, and each stage follows from the one before by the raster
// rules.
#include "reference/conformance/trace/stage_dump.h"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "raster/plain/plain_renderer.h"
#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/trace/fragments.h"
#include "reference/conformance/vectors/array_file.h"
#include "tests/support/raster_scenes.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using reference::Stages;
using reference::TestVector;

namespace {

std::vector<TestVector> chosen(const std::vector<std::string>& names) {
  std::vector<TestVector> vectors;
  for (TestVector& vector : reference::vectorSuite())
    if (std::find(names.begin(), names.end(), vector.name) != names.end()) vectors.push_back(std::move(vector));
  REQUIRE(vectors.size() == names.size());
  return vectors;
}

/// Calls check(index, column, row) for every pixel of a face, columns and rows counted in the viewport.
template <typename Check>
void forEachPixel(const raster::Face& face, const Check& check) {
  std::size_t index = 0;
  for (int row = face.scissor.row; row < face.scissor.row + face.scissor.height; ++row)
    for (int column = face.scissor.column; column < face.scissor.column + face.scissor.width; ++column, ++index)
      check(index, column, row);
}

const raster::Draw& firstDrawWith(const raster::DrawList& list, std::int32_t triangle) {
  const auto index = 3 * static_cast<std::uint32_t>(triangle);
  const auto draw = std::find_if(list.draws.begin(), list.draws.end(), [index](const raster::Draw& d) {
    return index >= d.first && index < d.first + d.count;
  });
  REQUIRE(draw != list.draws.end());
  return *draw;
}

/// Three corners x, y, w, u, v and their snapped positions.
struct Corners {
  std::array<raster::ViewVertex, 3> view;
  std::array<glm::ivec2, 3> snapped;
};

/// The triangle itself, or the pieces that clipping leaves of it.
std::vector<Corners> cornersOf(const raster::DrawList& list, const Stages& stages, std::int32_t triangle) {
  std::vector<Corners> pieces;
  for (std::size_t p = 0; p < stages.pieceTriangles.size(); ++p)
    if (stages.pieceTriangles[p] == triangle) pieces.push_back({stages.pieceCorners[p], stages.pieceSnapped[p]});
  if (!pieces.empty()) return pieces;
  Corners whole;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::uint32_t index = list.indices[3 * static_cast<std::size_t>(triangle) + k];
    const glm::vec3 view = stages.view[index];
    const glm::vec2 texcoord = list.texcoords[index];
    whole.view[k] = {view.x, view.y, view.z, texcoord.x, texcoord.y};
    whole.snapped[k] = stages.snapped[index];
    CHECK(whole.snapped[k].x != reference::notSnapped);
  }
  return {whole};
}

/// Twice the signed area that the edge from a to b spans with p.
double spanned(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p) {
  return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
}

/// 1/w, u/w and v/w at a sample that lies in the corners or on their sides.
std::optional<glm::dvec3> overDepth(const Corners& corners, const glm::dvec2& sample) {
  const std::array<glm::dvec2, 3> s{corners.snapped[0], corners.snapped[1], corners.snapped[2]};
  const double area = spanned(s[0], s[1], s[2]);
  glm::dvec3 sum(0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = spanned(s[(k + 1) % 3], s[(k + 2) % 3], sample) / area;
    if (!(weight >= 0)) return {};
    const raster::ViewVertex& view = corners.view[k];
    sum += weight / view.w * glm::dvec3(1, view.u, view.v);
  }
  return sum;
}

bool facesAway(const Corners& corners, const raster::Face& face) {
  const std::array<glm::dvec2, 3> s{corners.snapped[0], corners.snapped[1], corners.snapped[2]};
  return (spanned(s[0], s[1], s[2]) < 0) == (raster::determinant(face) < 0);
}

/// The corners that give a pixel its 1/w.
const Corners& shown(const std::vector<Corners>& pieces, const glm::dvec2& sample, double inverseDepth) {
  const auto gives = [&](const Corners& corners) {
    const std::optional<glm::dvec3> sum = overDepth(corners, sample);
    return sum && std::abs(sum->x - inverseDepth) <= 0x1p-48 * inverseDepth;
  };
  const auto found = std::find_if(pieces.begin(), pieces.end(), gives);
  REQUIRE(found != pieces.end());
  return *found;
}

}  // namespace

TEST_CASE("stagesOf holds the first fragment of every pixel", "[stages]") {
  for (const TestVector& vector :
       chosen({"five-faces", "perspective-clipped", "perspective-twist", "frustum-sheet", "behind-the-eye",
               "guard-band-sheet", "coplanar-slope", "same-triangle", "minified", "needles"}))
    for (const reference::VectorFace& face : vector.faces) {
      const Stages stages = reference::stagesOf(vector.list, face.face);
      const auto triangles = raster::snappedTriangles(vector.list, face.face);
      std::size_t wrong = 0;
      forEachPixel(face.face, [&](std::size_t pixel, int column, int row) {
        const auto fragments = reference::fragmentsAt(vector.list, triangles, column, row);
        reference::Fragment visible;
        if (!fragments.empty()) visible = fragments.front();
        const std::int32_t triangle = fragments.empty() ? -1 : static_cast<std::int32_t>(visible.triangle);
        const reference::Texel texel = visible.texel.value_or(reference::Texel{-1, -1});
        wrong += stages.triangles[pixel] != triangle || stages.inverseDepths[pixel] != visible.inverseDepth ||
                 stages.coordinates[pixel] != glm::dvec2(visible.u, visible.v) ||
                 stages.texels[pixel] != glm::ivec2(texel.column, texel.row);
      });
      INFO(vector.name << ", " << face.name);
      CHECK(wrong == 0);
    }
}

TEST_CASE("stagesOf determines every item ID of the suite: a blended texel, a back or an offset", "[stages]") {
  std::size_t textured = 0, backs = 0;
  for (const TestVector& vector : reference::vectorSuite()) {
    const raster::DrawList& list = vector.list;
    const std::vector<raster::ItemBuffer> expected = reference::render(vector);
    for (std::size_t f = 0; f < vector.faces.size(); ++f) {
      const raster::Face& face = vector.faces[f].face;
      const Stages stages = reference::stagesOf(list, face);
      std::size_t wrong = 0;
      forEachPixel(face, [&](std::size_t pixel, int column, int row) {
        raster::ItemId id = raster::backgroundId(list.format);
        const glm::ivec2 texel = stages.texels[pixel];
        if (stages.triangles[pixel] >= 0) {
          const raster::Draw& draw = firstDrawWith(list, stages.triangles[pixel]);
          id = draw.offset;
          if (texel.x >= 0) {
            ++textured;
            const raster::IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
            const raster::ItemId index = map.ids[static_cast<std::size_t>(texel.y * map.width + texel.x)];
            id = raster::blend(list.format, list.blend, draw.offset, index);
          } else if (draw.back) {
            const glm::dvec2 sample(256 * column + 128, 256 * row + 128);
            const std::vector<Corners> pieces = cornersOf(list, stages, stages.triangles[pixel]);
            if (facesAway(shown(pieces, sample, stages.inverseDepths[pixel]), face)) id = *draw.back;
            backs += id == *draw.back;
          }
        }
        wrong += id != expected[f].ids[pixel];
      });
      INFO(vector.name << ", " << vector.faces[f].name);
      CHECK(wrong == 0);
    }
  }
  CHECK(textured > 100000);
  CHECK(backs > 100);
}

TEST_CASE("stagesOf snaps vertices by the rule, except clipped ones", "[stages]") {
  for (const TestVector& vector : chosen({"five-faces", "frustum-sheet", "guard-band-sheet", "snapping-columns"}))
    for (const reference::VectorFace& face : vector.faces) {
      const raster::Face& view = face.face;
      const Stages stages = reference::stagesOf(vector.list, view);
      REQUIRE(stages.view.size() == vector.list.positions.size());
      std::size_t wrong = 0;
      for (std::size_t v = 0; v < stages.view.size(); ++v) {
        const glm::dvec3 p(stages.view[v]);
        const bool isInside = p.z >= view.nearDistance && std::max(std::abs(p.x), std::abs(p.y)) <= 8 * p.z;
        const glm::dvec2 rule(std::nearbyint((p.x / p.z + 1) * (128.0 * view.resolution)),
                              std::nearbyint((p.y / p.z + 1) * (128.0 * view.resolution)));
        wrong += glm::dvec2(stages.snapped[v]) != (isInside ? rule : glm::dvec2(-0x1p31));
      }
      INFO(vector.name << ", " << face.name);
      CHECK(wrong == 0);
    }
  // A front face shows (x, y, w) as it stands. Pixel (3, 5) of 8 begins at (3 * 256, 5 * 256).
  raster::DrawList list = tests::plainList();
  tests::addDraw(list, 0);
  tests::addTriangle(list, {reference::Picture(8).point({3, 5}, 2), {0, 0, -1}, {-17, 0, 2}});
  const Stages stages = reference::stagesOf(list, tests::frontFace(8));
  CHECK(stages.view[0] == list.positions[0]);
  CHECK(stages.snapped ==
        std::vector<glm::ivec2>{{768, 1280}, glm::ivec2(reference::notSnapped), glm::ivec2(reference::notSnapped)});
  CHECK_FALSE(stages.pieceTriangles.empty());
}

TEST_CASE("stagesOf gives depths, coordinates and texels that follow from snapped corners and pieces", "[stages]") {
  for (const TestVector& vector : chosen({"perspective-clipped", "perspective-floor", "five-faces", "behind-the-eye"}))
    for (const reference::VectorFace& face : vector.faces) {
      const Stages stages = reference::stagesOf(vector.list, face.face);
      CHECK(std::is_sorted(stages.pieceTriangles.begin(), stages.pieceTriangles.end()));
      INFO(vector.name << ", " << face.name);
      forEachPixel(face.face, [&](std::size_t pixel, int column, int row) {
        if (stages.triangles[pixel] < 0) return;
        const glm::dvec2 sample(256 * column + 128, 256 * row + 128);
        const std::vector<Corners> pieces = cornersOf(vector.list, stages, stages.triangles[pixel]);
        const glm::dvec3 sum = *overDepth(shown(pieces, sample, stages.inverseDepths[pixel]), sample);
        const glm::dvec2 coordinates = glm::dvec2(sum.y, sum.z) / sum.x;
        // No coordinate here exceeds 1.
        CHECK(glm::length(coordinates - stages.coordinates[pixel]) < 0x1p-46);
        if (stages.texels[pixel].x < 0) return;
        const raster::Draw& draw = firstDrawWith(vector.list, stages.triangles[pixel]);
        const raster::IndexMap& map = vector.list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
        // The middle of the texel is at most half a texel from the coordinates.
        const glm::dvec2 middle = (glm::dvec2(stages.texels[pixel]) + 0.5) / glm::dvec2(map.width, map.height);
        const glm::dvec2 offset = glm::abs(coordinates - middle) * glm::dvec2(map.width, map.height);
        CHECK(std::max(offset.x, offset.y) < 0.5 + 1e-9);
      });
    }
}

TEST_CASE("stagesOf gives the known 1/w on a slope", "[stages]") {
  // 1/w is 1 - column/32, at pixel centres 1 - (2i + 1)/64 (suite_depth.cpp).
  const TestVector vector = chosen({"coplanar-slope"}).front();
  const Stages stages = reference::stagesOf(vector.list, vector.faces.front().face);
  forEachPixel(vector.faces.front().face, [&](std::size_t pixel, int column, int) {
    const double inverseDepth = stages.triangles[pixel] < 0 ? 0 : 1 - (2 * column + 1) / 64.0;
    CHECK(std::abs(stages.inverseDepths[pixel] - inverseDepth) <= 0x1p-49 * inverseDepth);
  });
}

TEST_CASE("writeStages writes the arrays that stages.json names, in the order of faces", "[stages]") {
  const TestVector vector = chosen({"five-faces"}).front();
  const TemporaryFolder folder;
  reference::writeVector(folder.path, vector, reference::render(vector));
  reference::writeStages(folder.path, vector);
  CHECK(reference::readVector(folder.path).faces.size() == 5);
  std::ifstream stream(folder.path / "stages.json");
  const nlohmann::json faces = nlohmann::json::parse(stream)["faces"];
  REQUIRE(faces.size() == vector.faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const Stages stages = reference::stagesOf(vector.list, vector.faces[f].face);
    CHECK(faces[f]["name"] == vector.faces[f].name);
    const auto file = [&](const char* key) { return folder.path / faces[f][key].get<std::string>(); };
    CHECK(reference::readArray<std::int32_t>(file("triangles")) == stages.triangles);
    CHECK(reference::readArray<double>(file("inverse_depths")) == stages.inverseDepths);
    CHECK(reference::readArray<glm::dvec2>(file("coordinates")) == stages.coordinates);
    CHECK(reference::readArray<glm::ivec2>(file("texels")) == stages.texels);
    CHECK(reference::readArray<glm::vec3>(file("view")) == stages.view);
    CHECK(reference::readArray<glm::ivec2>(file("snapped")) == stages.snapped);
    CHECK(reference::readArray<std::int32_t>(file("piece_triangles")) == stages.pieceTriangles);
    CHECK(reference::readArray<double>(file("piece_corners")).size() == 15 * stages.pieceCorners.size());
    CHECK(reference::readArray<std::array<glm::ivec2, 3>>(file("piece_snapped")) == stages.pieceSnapped);
  }
}
