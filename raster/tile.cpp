#include "raster/tile.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "raster/cluster_triangles.h"
#include "raster/exact.h"
#include "raster/pixel_bounds.h"
#include "raster/screen_triangle.h"
#include "raster/small_triangle_kernels.h"
#include "raster/small_triangles.h"

namespace hemitex::raster {
namespace {

/// Pixels of a tile, at most: twelve bytes each in the depth buffer make 384 KiB, a part of today's second-level
/// caches. Wide, so that runs of pixels are long.
constexpr int mostColumns = 256, mostRows = 128;

/// How the pixels of a triangle get their words: all the same one, or by texels.
struct Shading {
  Word word;  ///< of all pixels, or the offset
  struct Texels {
    const IndexMap* map;
    bool isSum;   ///< the words are sums of offset and texel in which nothing is carried and nothing clamped
    bool counts;  ///< and the texels are their own numbers
    TexelPlanes planes;
    std::optional<ExactTexels> exact;  ///< once a texel was undecided, where there are any
  };
  std::optional<Texels> texels;
};

Shading shadingOf(const PreparedDraws& draws, const ScreenTriangle& triangle) {
  const DrawList& list = draws.list;
  const Draw& draw = list.draws[triangle.draw];
  if (triangle.facesAway && draw.back) return {*draw.back, {}};
  if (!draw.indexMap) return {draw.offset, {}};
  const IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  const PreparedDraws::MapTraits& traits = draws.maps[static_cast<std::size_t>(*draw.indexMap)];
  const bool isSum = list.blend != Blend::Replace && (draw.offset & traits.bits) == 0;
  return {draw.offset,
          Shading::Texels{&map, isSum, isSum && traits.countsTexels, TexelPlanes(triangle, map.width, map.height), {}}};
}

/// The word of a pixel that shows a draw, and of its index map, if any, a texel by number.
Word wordOf(const PreparedDraws& draws, const Draw& draw, bool facesAway, Word texel) {
  if (facesAway && draw.back) return *draw.back;
  if (!draw.indexMap) return draw.offset;
  const auto map = static_cast<std::size_t>(*draw.indexMap);
  const PreparedDraws::MapTraits& traits = draws.maps[map];
  const bool isSum = draws.list.blend != Blend::Replace && (draw.offset & traits.bits) == 0;
  if (isSum && traits.countsTexels) return draw.offset + texel;
  const Word word = draws.list.indexMaps[map].words[texel];
  return isSum ? draw.offset | word : blend(draws.list.format, draws.list.blend, draw.offset, word);
}

/// The number of the texel that a sample falls on.
Word texelExactly(const ScreenTriangle& triangle, const IndexMap& map, const Pixel& pixel) {
  const int column = texelExactly(triangle, triangle.u, map.width, pixel.column, pixel.row);
  const int row = texelExactly(triangle, triangle.v, map.height, pixel.column, pixel.row);
  return static_cast<Word>(row) * static_cast<Word>(map.width) + static_cast<Word>(column);
}

/// The part of a face that is drawn, while it is drawn.
class Tile {
 public:
  Tile(const PreparedDraws& draws, const PixelKernels& kernels, const Face& face)
      : draws_(draws),
        kernels_(kernels),
        buffer_(face.scissor),
        isMirrored_(determinant(face) < 0),
        small_(draws, face.scissor, isMirrored_),
        row_(buffer_.pitch) {}

  /// Whether nothing of a box can be seen behind what was drawn so far.
  bool hides(const BoxPlace& place) const { return kernels_.isHidden(buffer_, place.part, place.inverseDepth); }

  /// Offers a triangle to the depth buffer, and keeps it if a pixel took it.
  void draw(const ScreenTriangle& triangle);
  /// The same for small triangles of a cluster, a bit each.
  void draw(std::uint32_t cluster, const PlacedVertices& placed, std::uint32_t small);

  /// After all triangles: the words of a row of the face, in this tile's columns; valid until the next call.
  const Word* resolve(int row);

 private:
  ScreenTriangle screenTriangle(std::uint32_t number) const {
    return SmallTriangles::holds(number) ? small_.screenTriangle(number) : taken_[number];
  }
  bool offerExactly(const ScreenTriangle& triangle, std::uint32_t number, const Pixel& pixel);
  Shading& shading(std::uint32_t triangle);
  void resolveRun(const PixelRun& run, Shading& shading, Word* words);
  void findTexels(const PixelRun& run, Shading::Texels& texels, Word base, Word* words);
  void resolveSmall(std::uint32_t number, int row, int first, int end);
  void resolveWaiting(int row);

  const PreparedDraws& draws_;
  const PixelKernels& kernels_;
  DepthBuffer buffer_;
  bool isMirrored_;
  std::vector<ScreenTriangle> taken_;     ///< by some pixel
  std::vector<Shading> shadings_;         ///< of those that a pixel shows in the end
  std::vector<std::uint32_t> shadingOf_;  ///< of a taken triangle: its place in `shadings_`, or noTriangle
  SmallTriangles small_;
  std::vector<Word> row_;
  UndecidedPixels undecided_;
  UndecidedSamples undecidedSmall_;
  /// Pixels of the row that show small triangles and wait until they are many.
  struct Waiting {
    std::size_t count = 0;
    SmallPixels pixels{};
    std::array<std::uint32_t, mostSmallPixels> numbers;
    std::array<int, mostSmallPixels> columns;  ///< of the tile
    std::array<const Draw*, mostSmallPixels> draws;
  };
  Waiting waiting_;
};

/// The larger 1/w wins; on an exact tie the earlier triangle in draw order, whichever was drawn first.
bool isNearer(const ScreenTriangle& a, const ScreenTriangle& b, const Pixel& pixel) {
  if (isNearerExactly(a, b, pixel.column, pixel.row)) return true;
  return std::tie(a.draw, a.number) < std::tie(b.draw, b.number) && !isNearerExactly(b, a, pixel.column, pixel.row);
}

/// Whether the pixel took it.
bool Tile::offerExactly(const ScreenTriangle& triangle, std::uint32_t number, const Pixel& pixel) {
  const std::size_t p = buffer_.pixelAt(pixel.column, pixel.row);
  if (!isNearer(triangle, screenTriangle(buffer_.triangle[p]), pixel)) return false;
  buffer_.inverseDepth[p] = inverseDepthAt(triangle, edgeValues(triangle, pixel.column, pixel.row));
  buffer_.triangle[p] = number;
  return true;
}

void Tile::draw(const ScreenTriangle& triangle) {
  const auto number = static_cast<std::uint32_t>(taken_.size());
  bool isTaken = kernels_.offer(triangle, number, buffer_, undecided_);
  for (const Pixel& pixel : undecided_.pixels) isTaken = offerExactly(triangle, number, pixel) || isTaken;
  undecided_.pixels.clear();
  if (isTaken) taken_.push_back(triangle);
}

void Tile::draw(std::uint32_t cluster, const PlacedVertices& placed, std::uint32_t small) {
  const std::uint32_t first = small_.add(cluster, placed);
  bool isTaken = bestSmallTriangleKernels().offer({draws_.mesh, draws_.mesh.parts[cluster], placed, small, first},
                                                  buffer_, undecidedSmall_);
  for (const auto& [number, pixel] : undecidedSmall_.samples)
    isTaken = offerExactly(small_.screenTriangle(number), number, pixel) || isTaken;
  undecidedSmall_.samples.clear();
  if (!isTaken) small_.removeLast();
}

Shading& Tile::shading(std::uint32_t triangle) {
  shadingOf_.resize(taken_.size(), noTriangle);
  std::uint32_t& place = shadingOf_[triangle];
  if (place == noTriangle) {
    place = static_cast<std::uint32_t>(shadings_.size());
    shadings_.push_back(shadingOf(draws_, taken_[triangle]));
  }
  return shadings_[place];
}

/// `base` and the number of the texel of each pixel of a run. Where one texel is undecided, more will be.
void Tile::findTexels(const PixelRun& run, Shading::Texels& texels, Word base, Word* words) {
  const IndexMap& map = *texels.map;
  if (texels.exact) return kernels_.findExactTexels(run, *texels.exact, map.width, map.height, base, words);
  kernels_.findTexels(run, texels.planes, base, words, undecided_);
  if (undecided_.pixels.empty()) return;
  const auto u = exactQuotient(*run.triangle, run.triangle->u, map.width);
  const auto v = exactQuotient(*run.triangle, run.triangle->v, map.height);
  if (u && v) {
    texels.exact = {*u, *v};
    kernels_.findExactTexels(run, *texels.exact, map.width, map.height, base, words);
  } else {
    for (const Pixel& pixel : undecided_.pixels)
      words[pixel.column - run.firstColumn] = base + texelExactly(*run.triangle, map, pixel);
  }
  undecided_.pixels.clear();
}

/// The words of pixels that show one triangle.
void Tile::resolveRun(const PixelRun& run, Shading& shading, Word* words) {
  if (!shading.texels) {
    std::fill_n(words, run.count, shading.word);
    return;
  }
  Shading::Texels& texels = *shading.texels;
  findTexels(run, texels, texels.counts ? shading.word : 0, words);
  if (texels.counts) return;
  const Word* const map = texels.map->words.data();
  const DrawList& list = draws_.list;
  for (Word& word : std::span(words, static_cast<std::size_t>(run.count)))
    word = texels.isSum ? shading.word | map[word] : blend(list.format, list.blend, shading.word, map[word]);
}

const Word* Tile::resolve(int row) {
  const std::size_t begin = buffer_.rowAt(row);
  const std::uint32_t* const triangles = buffer_.triangle.data() + begin;
  const int width = buffer_.scissor.width;
  for (int first = 0, end = 0; first < width; first = end) {
    const std::uint32_t number = triangles[first];
    end = first + 1;
    if (end < width && triangles[end] == number) end = kernels_.endOfRun(triangles, first, width);
    if (number == noTriangle)
      std::fill(row_.begin() + first, row_.begin() + end, backgroundWord(draws_.list.format));
    else if (SmallTriangles::holds(number))
      resolveSmall(number, row, first, end);
    else
      resolveRun({&taken_[number], row, buffer_.scissor.column + first, end - first,
                  buffer_.inverseDepth.data() + begin + static_cast<std::size_t>(first)},
                 shading(number), row_.data() + first);
  }
  resolveWaiting(row);
  return row_.data();
}

/// Pixels of the tile's columns [first, end) that show one small triangle.
void Tile::resolveSmall(std::uint32_t number, int row, int first, int end) {
  const Draw& draw = small_.drawOf(number);
  const IndexMap* const map =
      draw.indexMap ? &draws_.list.indexMaps[static_cast<std::size_t>(*draw.indexMap)] : nullptr;
  for (int column = first; column < end; ++column) {
    const std::size_t i = waiting_.count++;
    small_.show(number, {buffer_.scissor.column + column, row}, waiting_.pixels, i);
    waiting_.pixels.columns[i] = map ? map->width : 1;
    waiting_.pixels.rows[i] = map ? map->height : 1;
    waiting_.numbers[i] = number;
    waiting_.columns[i] = column;
    waiting_.draws[i] = &draw;
    if (waiting_.count == mostSmallPixels) resolveWaiting(row);
  }
}

void Tile::resolveWaiting(int row) {
  const SmallTexels found = bestSmallTriangleKernels().findTexels(waiting_.pixels, waiting_.count);
  for (std::size_t i = 0; i < waiting_.count; ++i) {
    Word& word = row_[static_cast<std::size_t>(waiting_.columns[i])];
    const bool facesAway = ((found.negative >> i & 1) != 0) == isMirrored_;
    if ((found.decided >> i & 1) != 0) {
      word = wordOf(draws_, *waiting_.draws[i], facesAway, found.texels[i]);
      continue;
    }
    const ScreenTriangle triangle = small_.screenTriangle(waiting_.numbers[i]);
    Shading shading = shadingOf(draws_, triangle);
    const int column = buffer_.scissor.column + waiting_.columns[i];
    std::array<Word, 1 + mostLanes> words;
    resolveRun({&triangle, row, column, 1, buffer_.inverseDepth.data() + buffer_.pixelAt(column, row)}, shading,
               words.data());
    word = words.front();
  }
  waiting_.count = 0;
}

struct PlacedCluster {
  std::uint32_t cluster;
  BoxPlace place;
};

/// The clusters that a face may show, the nearest first.
std::vector<PlacedCluster> clustersIn(const PreparedDraws& draws, const Face& face) {
  const ViewBounds view(face);
  std::vector<PlacedCluster> found;
  for (const std::uint32_t c : draws.tree.clustersIn(view)) found.push_back({c, view.placeOf(draws.clusters[c].box)});
  std::sort(found.begin(), found.end(), [](const PlacedCluster& a, const PlacedCluster& b) {
    return std::tie(b.place.inverseDepth, a.cluster) < std::tie(a.place.inverseDepth, b.cluster);
  });
  return found;
}

}  // namespace

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
  PlacedVertices placed;
  std::vector<ScreenTriangle> triangles;
  for (const auto& [c, place] : clustersIn(draws, face)) {
    if (tile.hides(place)) continue;
    triangles.clear();
    const SeenTriangles seen = appendScreenTriangles(draws.list, draws.mesh, draws.clusters[c], draws.mesh.parts[c],
                                                     bestVertexKernels(), face, skipped, placed, triangles);
    dropped += seen.dropped;
    for (const ScreenTriangle& triangle : triangles) tile.draw(triangle);
    if (seen.small != 0) tile.draw(c, placed, seen.small);
  }
  for (int row = face.scissor.row; row < face.scissor.row + face.scissor.height; ++row, words += pitch)
    std::copy_n(tile.resolve(row), face.scissor.width, words);
  return dropped;
}

}  // namespace hemitex::raster
