#include "raster/tile.h"

#include <algorithm>
#include <optional>
#include <tuple>
#include <utility>

#include "raster/cluster_triangles.h"
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
      : draws_(draws), kernels_(kernels), buffer_(face.scissor), row_(buffer_.pitch) {}

  /// Whether nothing of a box can be seen behind what was drawn so far.
  bool hides(const BoxPlace& place) const { return kernels_.isHidden(buffer_, place.part, place.inverseDepth); }

  /// Offers the triangles of a cluster to the depth buffer, and keeps those that a pixel took.
  void draw(std::uint32_t cluster, std::span<const ScreenTriangle> triangles) {
    for (std::size_t i = 0; i < triangles.size(); ++i) draw(triangles[i], (std::uint64_t{cluster} << 32) + i);
  }

  /// After all triangles: the words of a row of the face, in this tile's columns; valid until the next call.
  const Word* resolve(int row);

 private:
  void draw(const ScreenTriangle& triangle, std::uint64_t order);
  bool isNearer(const ScreenTriangle& triangle, std::uint64_t order, std::uint32_t than, const Pixel& pixel) const;
  Shading& shading(std::uint32_t triangle);
  void resolveRun(const PixelRun& run, Shading& shading, Word* words);
  void findTexels(const PixelRun& run, Shading::Texels& texels, Word base, Word* words);

  const PreparedDraws& draws_;
  const PixelKernels& kernels_;
  DepthBuffer buffer_;
  std::vector<ScreenTriangle> taken_;     ///< by some pixel
  std::vector<std::uint64_t> orders_;     ///< of these: where in draw order they come
  std::vector<Shading> shadings_;         ///< of those that a pixel shows in the end
  std::vector<std::uint32_t> shadingOf_;  ///< of a taken triangle: its place in `shadings_`, or noTriangle
  std::vector<Word> row_;
  UndecidedPixels undecided_;
};

/// The larger 1/w wins; on an exact tie the earlier triangle in draw order, whichever was drawn first.
bool Tile::isNearer(const ScreenTriangle& triangle, std::uint64_t order, std::uint32_t than, const Pixel& pixel) const {
  if (isNearerExactly(triangle, taken_[than], pixel.column, pixel.row)) return true;
  return order < orders_[than] && !isNearerExactly(taken_[than], triangle, pixel.column, pixel.row);
}

void Tile::draw(const ScreenTriangle& triangle, std::uint64_t order) {
  const auto number = static_cast<std::uint32_t>(taken_.size());
  bool isTaken = kernels_.offer(triangle, number, buffer_, undecided_);
  for (const Pixel& pixel : undecided_.pixels) {
    const std::size_t p = buffer_.rowAt(pixel.row) + static_cast<std::size_t>(pixel.column - buffer_.scissor.column);
    if (!isNearer(triangle, order, buffer_.triangle[p], pixel)) continue;
    buffer_.inverseDepth[p] = inverseDepthAt(triangle, edgeValues(triangle, pixel.column, pixel.row));
    buffer_.triangle[p] = number;
    isTaken = true;
  }
  undecided_.pixels.clear();
  if (!isTaken) return;
  taken_.push_back(triangle);
  orders_.push_back(order);
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
    end = kernels_.endOfRun(triangles, first, width);
    const std::uint32_t number = triangles[first];
    if (number == noTriangle)
      std::fill(row_.begin() + first, row_.begin() + end, backgroundWord(draws_.list.format));
    else
      resolveRun({&taken_[number], row, buffer_.scissor.column + first, end - first,
                  buffer_.inverseDepth.data() + begin + static_cast<std::size_t>(first)},
                 shading(number), row_.data() + first);
  }
  return row_.data();
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

PreparedDraws prepare(DrawList list) {
  validate(list);
  PreparedDraws draws;
  draws.list = std::move(list);
  draws.clusters = clustersOf(draws.list);
  draws.tree = ClusterTree(draws.clusters);
  draws.mesh = meshOf(draws.list, draws.clusters);
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
  for (const auto& [c, place] : clustersIn(draws, face)) {
    if (tile.hides(place)) continue;
    triangles.clear();
    dropped += appendScreenTriangles(draws.list, draws.mesh, draws.clusters[c], draws.mesh.parts[c],
                                     bestVertexKernels(), face, skipped, triangles);
    tile.draw(c, triangles);
  }
  for (int row = face.scissor.row; row < face.scissor.row + face.scissor.height; ++row, words += pitch)
    std::copy_n(tile.resolve(row), face.scissor.width, words);
  return dropped;
}

}  // namespace hemitex::raster
