#include "raster/software/tile.h"

#include <algorithm>
#include <bit>
#include <memory>
#include <optional>
#include <tuple>

#include "raster/culling/frustum_culling.h"
#include "raster/kernels/interpolation_bounds.h"
#include "raster/setup/exact_interpolation.h"
#include "raster/software/cluster_setup.h"

namespace hemitex::raster {
namespace {

/// Maximum size of a tile. Twelve bytes per pixel in the depth buffer make 384 KiB, a fraction of current second-level
/// caches. Tiles are wide, so that runs of pixels are long.
constexpr int maxColumns = 256, maxRows = 128;

/// A part of a face while it is drawn.
class Tile {
 public:
  /// For `ids` and `pitch` see drawTile.
  Tile(const PreparedDrawList& draws, const Kernels& kernels, const Face& face, TileMemory& memory, ItemId* ids,
       std::size_t pitch)
      : draws_(draws),
        kernels_(kernels),
        face_(face),
        ids_(ids),
        pitch_(pitch),
        isMirrored_(determinant(face) < 0),
        memory_(memory),
        buffer_(memory.buffer),
        taken_(memory.taken) {
    buffer_.clear(face.scissor);
    taken_.clear();
    memory.shadings.clear();
    memory.unresolved.pixels.clear();
    memory.run.resize(buffer_.pitch);
    memory.runDepths.resize(buffer_.pitch);
  }

  /// Whether a box is outside the view or behind all that was drawn so far.
  bool hides(const BoxPlace& place) const { return kernels_.isHidden(buffer_, place.part, place.inverseDepth); }

  /// Draws a cluster without the triangles in `skipped` (ascending).
  void draw(std::uint32_t cluster, std::span<const std::uint32_t> skipped);

  /// Writes the remaining item IDs, after all triangles were drawn.
  void resolve();

 private:
  void drawWithHoles(const Cluster& cluster, std::span<const std::uint32_t> skipped);
  void testDepths(const ScreenTriangle& triangle);
  void testDepthsBesideHoles(const ScreenTriangle& triangle);
  void drawSmall(std::uint32_t number, const TriangleSets& sets);
  void drawAlone(std::uint32_t cluster, std::uint32_t t);
  SmallIds smallIds(const Cluster& cluster, const ClusterPart& part, std::uint32_t& alone);
  void drawUnresolved(const SmallIds& ids, std::uint32_t firstNumber);
  void resolveRow(int row);
  void resolveRun(const PixelRun& run, Shading& shading, ItemId* ids);
  void findTexels(const PixelRun& run, Shading::Texels& texels, ItemId base, ItemId* ids);

  ItemId* idsOf(int row) const { return ids_ + static_cast<std::size_t>(row - buffer_.scissor.row) * pitch_; }
  ScreenTriangle screenTriangle(std::uint32_t number) const;
  PixelRun coveredRun(const ScreenTriangle& triangle, int row);
  bool testDepth(const ScreenTriangle& triangle, std::uint32_t number, const Pixel& pixel, double inverseDepth);
  bool testExactly(const ScreenTriangle& triangle, std::uint32_t number, const Pixel& pixel);
  ItemId idExactly(std::uint32_t number, const Pixel& pixel);
  Shading& shading(std::uint32_t triangle);

  const PreparedDrawList& draws_;
  const Kernels& kernels_;
  const Face& face_;
  ItemId* ids_;
  std::size_t pitch_;
  bool isMirrored_;
  TileMemory& memory_;
  DepthBuffer& buffer_;
  std::vector<ScreenTriangle>& taken_;
};

/// The larger 1/w wins. On an exact tie the earlier triangle in draw order wins, whichever was tested first.
bool isNearer(const ScreenTriangle& a, const ScreenTriangle& b, const Pixel& pixel) {
  if (isNearerExactly(a, b, pixel.column, pixel.row)) return true;
  return std::tie(a.draw, a.number) < std::tie(b.draw, b.number) && !isNearerExactly(b, a, pixel.column, pixel.row);
}

/// A triangle by its number in the depth buffer. Small triangles are set up again, because few pixels need that.
ScreenTriangle Tile::screenTriangle(std::uint32_t number) const {
  if (!isSmall(number)) return taken_[number];
  const std::uint32_t inMesh = number - firstSmall;
  const auto part = std::upper_bound(draws_.mesh.parts.begin(), draws_.mesh.parts.end(), inMesh,
                                     [](std::uint32_t t, const ClusterPart& p) { return t < p.firstTriangle; }) -
                    1;
  const Cluster& cluster = draws_.clusters[static_cast<std::size_t>(part - draws_.mesh.parts.begin())];
  const TriangleRun one = triangleOf(cluster, inMesh - part->firstTriangle);
  std::vector<ScreenTriangle> alone;
  appendScreenTriangles(draws_.list, face_, {&one, 1}, {}, alone);
  return alone.front();
}

/// Returns whether the pixel took the triangle.
bool Tile::testExactly(const ScreenTriangle& triangle, std::uint32_t number, const Pixel& pixel) {
  const std::size_t p = buffer_.pixelAt(pixel.column, pixel.row);
  if (!isNearer(triangle, screenTriangle(buffer_.triangle[p]), pixel)) return false;
  buffer_.inverseDepth[p] = inverseDepthAt(triangle, edgeValues(triangle, pixel.column, pixel.row));
  buffer_.triangle[p] = number;
  return true;
}

void Tile::draw(std::uint32_t number, std::span<const std::uint32_t> skipped) {
  memory_.triangles.clear();
  const Cluster& cluster = draws_.clusters[number];
  if (cluster.indexMap && draws_.maps[static_cast<std::size_t>(*cluster.indexMap)].hasHoles)
    return drawWithHoles(cluster, skipped);
  const TriangleSets left = appendScreenTriangles(draws_.list, draws_.mesh, cluster, draws_.mesh.parts[number],
                                                  kernels_, face_, skipped, memory_.placed, memory_.triangles);
  for (const ScreenTriangle& triangle : memory_.triangles) testDepths(triangle);
  if (left.small != 0) drawSmall(number, left);
}

/// Draws a cluster whose index map has holes. Its small triangles are drawn like large ones, because the kernels of
/// small triangles test depths before they find texels.
void Tile::drawWithHoles(const Cluster& cluster, std::span<const std::uint32_t> skipped) {
  appendScreenTriangles(draws_.list, face_, cluster.runs, skipped, memory_.triangles);
  for (const ScreenTriangle& triangle : memory_.triangles)
    draws_.list.draws[triangle.draw].indexMap ? testDepthsBesideHoles(triangle) : testDepths(triangle);
}

/// Tests a triangle against the depth buffer, and keeps it if a pixel took it.
void Tile::testDepths(const ScreenTriangle& triangle) {
  const auto number = static_cast<std::uint32_t>(taken_.size());
  bool isTaken = kernels_.testDepths(triangle, number, buffer_, memory_.unresolved);
  for (const Pixel& pixel : memory_.unresolved.pixels) isTaken = testExactly(triangle, number, pixel) || isTaken;
  memory_.unresolved.pixels.clear();
  if (isTaken) taken_.push_back(triangle);
}

/// As testDepths, without the samples that meet a hole of the index map.
void Tile::testDepthsBesideHoles(const ScreenTriangle& triangle) {
  const IndexMap& map = mapOf(draws_.list, draws_.list.draws[triangle.draw]);
  Shading::Texels texels{&map, false, false, TexelPlanes(triangle, map.width, map.height), {}};
  const auto number = static_cast<std::uint32_t>(taken_.size());
  bool isTaken = false;
  for (int row = triangle.firstRow; row < triangle.endRow; ++row) {
    const PixelRun run = coveredRun(triangle, row);
    if (run.count == 0) continue;
    findTexels(run, texels, 0, memory_.run.data());
    for (int i = 0; i < run.count; ++i)
      if (map.ids[memory_.run[static_cast<std::size_t>(i)]] != holeTexel)
        isTaken = testDepth(triangle, number, {run.firstColumn + i, row}, run.inverseDepth[i]) || isTaken;
  }
  if (isTaken) taken_.push_back(triangle);
}

/// The samples of a row that a triangle covers, which are adjacent, with their depths.
PixelRun Tile::coveredRun(const ScreenTriangle& triangle, int row) {
  int first = triangle.firstColumn, end = triangle.endColumn;
  while (first < end && !covers(triangle, first, row)) ++first;
  while (first < end && !covers(triangle, end - 1, row)) --end;
  double* const depths = memory_.runDepths.data();
  for (int column = first; column < end; ++column)
    depths[column - first] = inverseDepthAt(triangle, edgeValues(triangle, column, row));
  return {&triangle, row, first, end - first, depths};
}

/// Tests the depth of one sample. Returns whether the pixel took the triangle.
bool Tile::testDepth(const ScreenTriangle& triangle, std::uint32_t number, const Pixel& pixel, double inverseDepth) {
  const std::size_t p = buffer_.pixelAt(pixel.column, pixel.row);
  if (isUnresolved(inverseDepth, buffer_.inverseDepth[p])) return testExactly(triangle, number, pixel);
  if (inverseDepth < buffer_.inverseDepth[p]) return false;
  buffer_.inverseDepth[p] = inverseDepth;
  buffer_.triangle[p] = number;
  return true;
}

/// Draws a small triangle of a cluster like a large one.
void Tile::drawAlone(std::uint32_t cluster, std::uint32_t t) {
  ScreenTriangle triangle;
  if (makeScreenTriangle(draws_.list, draws_.mesh, draws_.clusters[cluster], draws_.mesh.parts[cluster], t,
                         memory_.placed, face_.scissor, isMirrored_, triangle))
    testDepths(triangle);
}

/// The item IDs of the small triangles of a cluster after setup. Those of texels that are no sum with the offset stay
/// in `alone`, and have no rows to draw. Culled triangles have none either.
SmallIds Tile::smallIds(const Cluster& cluster, const ClusterPart& part, std::uint32_t& alone) {
  SmallSetup& setup = memory_.small;
  SmallIds ids;
  if (cluster.indexMap) {
    const auto number = static_cast<std::size_t>(*cluster.indexMap);
    const IndexMap& map = draws_.list.indexMaps[number];
    ids.columns = map.width;
    ids.rows = map.height;
    if (!draws_.maps[number].countsTexels) ids.map = map.ids.data();
  }
  for (std::uint32_t k = 0; k < setup.count; ++k) {
    const std::uint32_t inMesh = part.firstTriangle + static_cast<std::uint32_t>(setup.triangles[k]);
    const Draw& draw = draws_.list.draws[draws_.mesh.draws[inMesh]];
    const bool facesAway = ((setup.negative >> k & 1) != 0) == isMirrored_;
    if (isCulled(draw, facesAway)) {
      setup.rows[k] = 0;
    } else if (!isTextured(draws_.list, draw, facesAway) || (setup.uniform >> k & 1) != 0) {
      const bool isNumbered = draws_.list.value == PixelValue::TriangleNumbers;
      const std::uint32_t t =
          isNumbered ? triangleOf(cluster, static_cast<std::uint32_t>(setup.triangles[k])).first : 0;
      ids.ids[k] = idOf(draws_, draw, t, facesAway, static_cast<ItemId>(setup.texel[k]));
    } else if (const std::optional<ItemId> addend = addendOf(draws_, draw)) {
      ids.textured |= 1U << k;
      ids.ids[k] = *addend;
    } else {
      alone |= 1U << k;
      setup.rows[k] = 0;
    }
  }
  return ids;
}

/// Draws the small triangles of a cluster.
void Tile::drawSmall(std::uint32_t number, const TriangleSets& sets) {
  const Cluster& cluster = draws_.clusters[number];
  const ClusterPart& part = draws_.mesh.parts[number];
  SmallTriangles triangles{draws_.mesh, part, memory_.placed, sets.small, sets.tiny};
  if (cluster.indexMap) {
    const IndexMap& map = draws_.list.indexMaps[static_cast<std::size_t>(*cluster.indexMap)];
    triangles.columns = map.width;
    triangles.rows = map.height;
  }
  SmallSetup& setup = memory_.small;
  kernels_.setUpSmall(triangles, buffer_.scissor, setup);
  if (setup.count == 0) return;
  std::uint32_t alone = setup.thin;
  const SmallIds ids = smallIds(cluster, part, alone);
  const std::uint32_t firstNumber = firstSmall + part.firstTriangle;
  kernels_.drawSmall(setup, ids, firstNumber, buffer_, memory_.unresolvedSamples);
  drawUnresolved(ids, firstNumber);
  for (; alone != 0; alone &= alone - 1)
    drawAlone(number, static_cast<std::uint32_t>(setup.triangles[static_cast<std::size_t>(std::countr_zero(alone))]));
}

/// Draws the samples of small triangles that are not resolved in double precision.
void Tile::drawUnresolved(const SmallIds& ids, std::uint32_t firstNumber) {
  for (const auto& [k, pixel] : memory_.unresolvedSamples.samples) {
    const std::uint32_t number = firstNumber + static_cast<std::uint32_t>(memory_.small.triangles[k]);
    // If the pixel shows the triangle, its texel is unresolved, else its depth.
    const std::size_t at = buffer_.pixelAt(pixel.column, pixel.row);
    if (buffer_.triangle[at] != number && !testExactly(screenTriangle(number), number, pixel)) continue;
    buffer_.id[at] = (ids.textured >> k & 1) != 0 ? idExactly(number, pixel) : ids.ids[k];
  }
  memory_.unresolvedSamples.samples.clear();
}

/// The item ID of a pixel that shows a texel, computed exactly.
ItemId Tile::idExactly(std::uint32_t number, const Pixel& pixel) {
  const ScreenTriangle triangle = screenTriangle(number);
  const Draw& draw = draws_.list.draws[triangle.draw];
  const IndexMap& map = draws_.list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
  return idOf(draws_, draw, triangle.number, triangle.facesAway, texelExactly(triangle, map, pixel));
}

Shading& Tile::shading(std::uint32_t triangle) {
  std::uint32_t& place = memory_.shadingOf[triangle];
  if (place == noTriangle) {
    place = static_cast<std::uint32_t>(memory_.shadings.size());
    memory_.shadings.push_back(shadingOf(draws_, taken_[triangle]));
  }
  return memory_.shadings[place];
}

/// `base` plus the texel number of each pixel of a run. If one texel of a triangle is unresolved, others usually are
/// too; from then on the triangle uses exact quotients.
void Tile::findTexels(const PixelRun& run, Shading::Texels& texels, ItemId base, ItemId* ids) {
  const IndexMap& map = *texels.map;
  if (texels.exact) return kernels_.findExactTexels(run, *texels.exact, map.width, map.height, base, ids);
  kernels_.findTexels(run, texels.planes, base, ids, memory_.unresolved);
  if (memory_.unresolved.pixels.empty()) return;
  const auto u = exactQuotient(*run.triangle, run.triangle->u, map.width);
  const auto v = exactQuotient(*run.triangle, run.triangle->v, map.height);
  if (u && v) {
    texels.exact = std::make_unique<const ExactTexels>(ExactTexels{*u, *v});
    kernels_.findExactTexels(run, *texels.exact, map.width, map.height, base, ids);
  } else {
    for (const Pixel& pixel : memory_.unresolved.pixels)
      ids[pixel.column - run.firstColumn] = base + texelExactly(*run.triangle, map, pixel);
  }
  memory_.unresolved.pixels.clear();
}

/// The item IDs of pixels that show one triangle.
void Tile::resolveRun(const PixelRun& run, Shading& shading, ItemId* ids) {
  if (!shading.texels) {
    std::fill_n(ids, run.count, shading.id);
    return;
  }
  Shading::Texels& texels = *shading.texels;
  findTexels(run, texels, texels.counts ? shading.id : 0, ids);
  if (texels.counts) return;
  const ItemId* const map = texels.map->ids.data();
  const DrawList& list = draws_.list;
  for (ItemId& id : std::span(ids, static_cast<std::size_t>(run.count)))
    id = texels.isSum ? shading.id | map[id] : blend(list.format, list.blend, shading.id, map[id]);
}

void Tile::resolve() {
  memory_.shadingOf.assign(taken_.size(), noTriangle);
  for (int row = buffer_.scissor.row; row < buffer_.scissor.row + buffer_.scissor.height; ++row) resolveRow(row);
}

void Tile::resolveRow(int row) {
  ItemId* const ids = idsOf(row);
  const std::size_t begin = buffer_.rowAt(row);
  const std::uint32_t* const triangles = buffer_.triangle.data() + begin;
  const ItemId* const smallIds = buffer_.id.data() + begin;
  const int width = buffer_.scissor.width;
  for (int first = 0, end = 0; first < width; first = end) {
    const std::uint32_t number = triangles[first];
    if (isSmall(number)) {
      end = kernels_.endOfSmall(triangles, first, width);
      std::copy(smallIds + first, smallIds + end, ids + first);
      continue;
    }
    end = first + 1;
    if (end < width && triangles[end] == number) end = kernels_.endOfRun(triangles, first, width);
    if (number == noTriangle) {
      std::fill(ids + first, ids + end, backgroundId(draws_.list.format));
      continue;
    }
    resolveRun({&taken_[number], row, buffer_.scissor.column + first, end - first,
                buffer_.inverseDepth.data() + begin + static_cast<std::size_t>(first)},
               shading(number), memory_.run.data());
    std::copy_n(memory_.run.data(), end - first, ids + first);
  }
}

struct PlacedGroup {
  std::uint32_t number;
  BoxPlace place;
};

/// The groups of clusters that a view may show, nearest first. Groups instead of single clusters, because consecutive
/// clusters are faster to read and a hidden group needs one test.
std::vector<PlacedGroup> groupsIn(const ClusterBvh& tree, const ViewBounds& view) {
  std::vector<PlacedGroup> found;
  for (const std::uint32_t g : tree.groupsIn(view)) found.push_back({g, view.placeOf(tree.group(g).box)});
  std::sort(found.begin(), found.end(), [](const PlacedGroup& a, const PlacedGroup& b) {
    return std::tie(b.place.inverseDepth, a.number) < std::tie(a.place.inverseDepth, b.number);
  });
  return found;
}

}  // namespace

std::vector<Scissor> tilesOf(const Face& face) {
  const Scissor& whole = face.scissor;
  std::vector<Scissor> tiles;
  for (int row = whole.row; row < whole.row + whole.height; row += maxRows)
    for (int column = whole.column; column < whole.column + whole.width; column += maxColumns)
      tiles.push_back({column, row, std::min(maxColumns, whole.column + whole.width - column),
                       std::min(maxRows, whole.row + whole.height - row)});
  return tiles;
}

void drawTile(const PreparedDrawList& draws, const Kernels& kernels, const Face& face,
              std::span<const std::uint32_t> skipped, TileMemory& memory, ItemId* ids, std::size_t pitch) {
  const ViewBounds view(face);
  const std::vector<PlacedGroup> groups = groupsIn(draws.tree, view);
  if (groups.empty()) {
    for (int row = 0; row < face.scissor.height; ++row)
      std::fill_n(ids + static_cast<std::size_t>(row) * pitch, face.scissor.width, backgroundId(draws.list.format));
    return;
  }
  Tile tile(draws, kernels, face, memory, ids, pitch);
  std::optional<std::uint32_t> awaited;  // the cluster that is being prefetched
  for (const PlacedGroup& placed : groups) {
    if (tile.hides(placed.place)) continue;
    const ClusterGroup& group = draws.tree.group(placed.number);
    for (std::uint32_t c = group.first; c < group.end; ++c) {
      if (tile.hides(view.placeOf(draws.clusters[c].box))) continue;
      prefetch(draws, c);
      if (awaited) tile.draw(*awaited, skipped);
      awaited = c;
    }
  }
  if (awaited) tile.draw(*awaited, skipped);
  tile.resolve();
}

}  // namespace hemitex::raster
