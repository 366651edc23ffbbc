#include "reference/conformance/verdict/verdict.h"

#include <algorithm>
#include <cassert>
#include <iterator>

#include "raster/base/parallel.h"

namespace hemitex::reference {
namespace {

constexpr int tileSide = 16;  // pixels

/// The pixels of a scissor rectangle in square tiles, so that each pixel tests only nearby triangles.
struct Tiles {
  raster::Scissor scissor;
  int columns, rows;

  explicit Tiles(const raster::Scissor& rectangle)
      : scissor(rectangle),
        columns((rectangle.width + tileSide - 1) / tileSide),
        rows((rectangle.height + tileSide - 1) / tileSide) {}

  std::size_t size() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }

  /// Calls visit(tile) for each tile with a sample that the triangle may cover, and perhaps others.
  template <typename Visit>
  void forEach(const DeviceTriangle& triangle, const Visit& visit) const {
    const Extent extent = extentOf(triangle);
    // One more pixel on either side: the bounds need not be tight.
    const glm::dvec2 corner(scissor.column, scissor.row);
    const auto tileOf = [&](const glm::dvec2& position) {
      return glm::floor((position / 256.0 - corner) / static_cast<double>(tileSide));
    };
    const glm::dvec2 last(columns - 1, rows - 1);
    const glm::dvec2 from = glm::max(tileOf(extent.low - triangle.reach - 256.0), glm::dvec2(0.0));
    const glm::dvec2 to = glm::min(tileOf(extent.high + triangle.reach + 256.0), last);
    for (int row = static_cast<int>(from.y); row <= to.y; ++row)
      for (int column = static_cast<int>(from.x); column <= to.x; ++column) visit(index(column, row));
  }
};

/// The pixels to judge, by tile: indices into the item buffer.
using TilePixels = std::vector<std::vector<std::size_t>>;

TilePixels errorsOf(const FaceVerdict& face, const Tiles& tiles) {
  TilePixels pixels(tiles.size());
  for (std::size_t index = 0; index < face.pixels.size(); ++index) {
    const glm::ivec2 tile =
        (pixelAt(face.scissor, index) - glm::ivec2(face.scissor.column, face.scissor.row)) / tileSide;
    if (face.pixels[index] == PixelVerdict::Error) pixels[tiles.index(tile.x, tile.y)].push_back(index);
  }
  return pixels;
}

/// Judges again each pixel that is an error so far. With `loose`, loose clipping explains it.
void judgeErrors(const raster::DrawList& list, const raster::Face& view, const DeviceProfile& profile, bool loose,
                 FaceVerdict& face) {
  const Tiles tiles(face.scissor);
  const TilePixels pixels = errorsOf(face, tiles);
  const auto isWanted = [&](const DeviceTriangle& triangle) {
    bool wanted = false;
    tiles.forEach(triangle, [&](std::size_t tile) { wanted |= !pixels[tile].empty(); });
    return wanted;
  };
  const std::vector<DeviceTriangle> triangles = placeTriangles(list, view, profile, loose, isWanted);
  std::vector<std::vector<const DeviceTriangle*>> nearby(tiles.size());
  for (const DeviceTriangle& triangle : triangles)
    tiles.forEach(triangle, [&](std::size_t tile) {
      if (!pixels[tile].empty()) nearby[tile].push_back(&triangle);
    });

  const JudgedFace judged = judgedFace(list, view, profile);
  raster::parallelFor(tiles.size(), [&](std::size_t tile) {
    for (const std::size_t pixel : pixels[tile]) {
      const glm::ivec2 at = pixelAt(face.scissor, pixel);
      const PixelVerdict verdict = judgeId(judged, nearby[tile], raster::sampleOf(at.x, at.y), face.found.ids[pixel]);
      const bool isExplained = verdict != PixelVerdict::Error;
      face.pixels[pixel] = loose && isExplained ? PixelVerdict::LooseClipping : verdict;
    }
  });
}

FaceVerdict judgeFace(const raster::DrawList& list, const VectorFace& vectorFace, const raster::ItemBuffer& expected,
                      const raster::ItemBuffer& found, const DeviceProfile& profile) {
  assert(found.ids.size() == expected.ids.size());
  FaceVerdict face{vectorFace.name, vectorFace.face.scissor, expected, found, {}};
  std::transform(expected.ids.begin(), expected.ids.end(), found.ids.begin(), std::back_inserter(face.pixels),
                 [](raster::ItemId a, raster::ItemId b) { return a == b ? PixelVerdict::Exact : PixelVerdict::Error; });
  const auto anyError = [&] {
    return std::find(face.pixels.begin(), face.pixels.end(), PixelVerdict::Error) != face.pixels.end();
  };
  const raster::Face& view = vectorFace.face;
  if (list.value == raster::PixelValue::PassedSamples) return face;
  if (anyError()) judgeErrors(list, view, profile, false, face);
  if (profile.looseClipping && anyError()) judgeErrors(list, view, profile, true, face);
  return face;
}

}  // namespace

VerdictCounts countVerdicts(const FaceVerdict& face) {
  VerdictCounts counts{};
  for (const PixelVerdict verdict : face.pixels) ++counts[static_cast<std::size_t>(verdict)];
  return counts;
}

VerdictCounts countVerdicts(const Verdict& verdict) {
  VerdictCounts sums{};
  for (const FaceVerdict& face : verdict.faces) {
    const VerdictCounts counts = countVerdicts(face);
    for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += counts[k];
  }
  return sums;
}

bool hasErrors(const Verdict& verdict) {
  return countVerdicts(verdict)[static_cast<std::size_t>(PixelVerdict::Error)] > 0;
}

Verdict judge(const TestVector& vector, std::span<const raster::ItemBuffer> expected,
              std::span<const raster::ItemBuffer> found, const DeviceProfile& profile) {
  assert(found.size() == vector.faces.size() && expected.size() == vector.faces.size());
  Verdict verdict{vector.name, {}};
  for (std::size_t f = 0; f < found.size(); ++f)
    verdict.faces.push_back(judgeFace(vector.list, vector.faces[f], expected[f], found[f], profile));
  return verdict;
}

Verdict judge(const TestVector& vector, std::span<const raster::ItemBuffer> found, const DeviceProfile& profile) {
  return judge(vector, render(vector), found, profile);
}

}  // namespace hemitex::reference
