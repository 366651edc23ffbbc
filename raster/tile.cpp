#include "raster/tile.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "raster/exact.h"
#include "raster/pixel_bounds.h"
#include "raster/screen_triangle.h"

namespace hemitex::raster {
namespace {

/// Pixels of a tile, at most: twelve bytes each in the depth buffer make 384 KiB, a part of today's second-level
/// caches. Wide, so that runs of pixels are long.
constexpr int mostColumns = 256, mostRows = 128;

PreparedDraws::MapTraits traitsOf(const IndexMap& map) {
  PreparedDraws::MapTraits traits{true, 0};
  for (std::size_t i = 0; i < map.words.size(); ++i) {
    traits.countsTexels = traits.countsTexels && map.words[i] == i;
    traits.bits |= map.words[i];
  }
  return traits;
}

/// The number of the texel that a sample falls on.
Word texelExactly(const ScreenTriangle& triangle, const IndexMap& map, const Pixel& pixel) {
  const int column = texelExactly(triangle, triangle.u.at, map.width, pixel.column, pixel.row);
  const int row = texelExactly(triangle, triangle.v.at, map.height, pixel.column, pixel.row);
  return static_cast<Word>(row) * static_cast<Word>(map.width) + static_cast<Word>(column);
}

/// The part of a face that is drawn, while it is drawn.
class Tile {
 public:
  Tile(const PreparedDraws& draws, const PixelKernels& kernels, const Face& face)
      : draws_(draws), kernels_(kernels), buffer_(face.scissor), row_(buffer_.pitch) {}

  /// Offers triangles to the depth buffer, and keeps those that a pixel took.
  void draw(std::span<const ScreenTriangle> triangles) {
    for (const ScreenTriangle& triangle : triangles) draw(triangle);
  }

  /// The words of a row of the face, in this tile's columns; valid until the next call.
  const Word* resolve(int row);

 private:
  void draw(const ScreenTriangle& triangle);
  void resolveRun(const PixelRun& run, Word* words);
  void resolveTexels(const PixelRun& run, const Draw& draw, Word* words);
  void findTexels(const PixelRun& run, const IndexMap& map, Word base, Word* texels);

  const PreparedDraws& draws_;
  const PixelKernels& kernels_;
  DepthBuffer buffer_;
  std::vector<ScreenTriangle> visible_;
  std::vector<Word> row_;
  UndecidedPixels undecided_;
  /// Of triangles that had an undecided texel and are exact quotients.
  std::unordered_map<const ScreenTriangle*, ExactTexels> exact_;
};

void Tile::draw(const ScreenTriangle& triangle) {
  const auto number = static_cast<std::uint32_t>(visible_.size());
  bool isTaken = kernels_.offer(triangle, number, buffer_, undecided_);
  for (const Pixel& pixel : undecided_.pixels) {
    const std::size_t p = buffer_.rowAt(pixel.row) + static_cast<std::size_t>(pixel.column - buffer_.scissor.column);
    if (!isNearerExactly(triangle, visible_[buffer_.triangle[p]], pixel.column, pixel.row)) continue;
    buffer_.inverseDepth[p] = inverseDepthAt(triangle, edgeValues(triangle, pixel.column, pixel.row));
    buffer_.triangle[p] = number;
    isTaken = true;
  }
  undecided_.pixels.clear();
  if (isTaken) visible_.push_back(triangle);
}

/// The words of pixels that show one triangle: back, plain offset, or offset and texel blended.
void Tile::resolveRun(const PixelRun& run, Word* words) {
  const Draw& draw = draws_.list.draws[run.triangle->draw];
  if (run.triangle->facesAway && draw.back)
    std::fill_n(words, run.count, *draw.back);
  else if (draw.indexMap)
    resolveTexels(run, draw, words);
  else
    std::fill_n(words, run.count, draw.offset);
}

/// `base` and the number of the texel of each pixel of a run. Where one texel is undecided, more will be.
void Tile::findTexels(const PixelRun& run, const IndexMap& map, Word base, Word* texels) {
  if (const auto known = exact_.find(run.triangle); known != exact_.end())
    return kernels_.findExactTexels(run, known->second, map.width, map.height, base, texels);
  kernels_.findTexels(run, map.width, map.height, base, texels, undecided_);
  if (undecided_.pixels.empty()) return;
  const auto u = exactQuotient(*run.triangle, run.triangle->u.at, map.width);
  const auto v = exactQuotient(*run.triangle, run.triangle->v.at, map.height);
  if (u && v)
    kernels_.findExactTexels(run, exact_[run.triangle] = {*u, *v}, map.width, map.height, base, texels);
  else
    for (const Pixel& pixel : undecided_.pixels)
      texels[pixel.column - run.firstColumn] = base + texelExactly(*run.triangle, map, pixel);
  undecided_.pixels.clear();
}

void Tile::resolveTexels(const PixelRun& run, const Draw& draw, Word* words) {
  const DrawList& list = draws_.list;
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const PreparedDraws::MapTraits& traits = draws_.maps[static_cast<std::size_t>(*draw.indexMap)];
  // Where offset and texels have no bit in common, nothing is carried and nothing clamped.
  const bool isSum = list.blend != Blend::Replace && (draw.offset & traits.bits) == 0;
  const Word base = isSum && traits.countsTexels ? draw.offset : 0;
  findTexels(run, map, base, words);
  if (isSum && traits.countsTexels) return;
  for (Word& word : std::span(words, static_cast<std::size_t>(run.count)))
    word = isSum ? draw.offset | map.words[word] : blend(list.format, list.blend, draw.offset, map.words[word]);
}

const Word* Tile::resolve(int row) {
  const std::size_t begin = buffer_.rowAt(row);
  const std::uint32_t* const triangles = buffer_.triangle.data() + begin;
  const int width = buffer_.scissor.width;
  for (int first = 0, end = 0; first < width; first = end) {
    end = kernels_.endOfRun(triangles, first, width);
    if (triangles[first] == noTriangle)
      std::fill(row_.begin() + first, row_.begin() + end, backgroundWord(draws_.list.format));
    else
      resolveRun({&visible_[triangles[first]], row, buffer_.scissor.column + first, end - first,
                  buffer_.inverseDepth.data() + begin + static_cast<std::size_t>(first)},
                 row_.data() + first);
  }
  return row_.data();
}

}  // namespace

PreparedDraws prepare(DrawList list) {
  validate(list);
  PreparedDraws draws{std::move(list), {}, {}};
  draws.clusters = clustersOf(draws.list);
  for (const IndexMap& map : draws.list.indexMaps) draws.maps.push_back(traitsOf(map));
  return draws;
}

std::vector<Scissor> tilesOf(const Face& face) {
  const Scissor& whole = face.scissor;
  std::vector<Scissor> tiles;
  for (int row = whole.row; row < whole.row + whole.height; row += mostRows)
    for (int column = whole.column; column < whole.column + whole.width; column += mostColumns)
      tiles.push_back({column, row, std::min(mostColumns, whole.column + whole.width - column),
                       std::min(mostRows, whole.row + whole.height - row)});
  return tiles;
}

std::uint64_t drawTile(const PreparedDraws& draws, const PixelKernels& kernels, const Face& face,
                       std::span<const std::uint32_t> skipped, Word* words, std::size_t pitch) {
  std::uint64_t dropped = 0;
  Tile tile(draws, kernels, face);
  std::vector<ScreenTriangle> triangles;
  for (const Cluster& cluster : draws.clusters) {
    if (!mayCover(face, cluster)) continue;
    triangles.clear();
    dropped += appendScreenTriangles(draws.list, face, cluster.runs, skipped, triangles);
    tile.draw(triangles);
  }
  for (int row = face.scissor.row; row < face.scissor.row + face.scissor.height; ++row, words += pitch)
    std::copy_n(tile.resolve(row), face.scissor.width, words);
  return dropped;
}

}  // namespace hemitex::raster
