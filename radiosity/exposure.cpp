#include "radiosity/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "radiosity/drawn_rows.h"
#include "radiosity/hemicube.h"
#include "radiosity/shooting_view.h"
#include "radiosity/texel_areas.h"
#include "radiosity/triangle_slices.h"

namespace hemitex::radiosity {
namespace {

/// Of the hemicubes that say what a region sees.
constexpr int resolution = 16;
/// Points of a region that look.
constexpr std::size_t pointsOfRegion = 4;
/// A region is exposed where exposed fronts are at least this share of all exposed fronts and backs that it sees.
constexpr double leastExposed = 0.1;
/// Pieces of a texel of which every pair is looked at; of more, neighbours in their order.
constexpr std::size_t mostPaired = 48;
/// Relative to the area of its triangle; a smaller piece is rounding noise.
constexpr double smallestShare = 1e-14;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The part of a triangle in a texel, or one of the pieces that slices cut it into.
struct Cutting {
  std::uint32_t texel = 0, triangle = 0;
  std::optional<Piece> piece = {};  ///< where there are several in the texel
  glm::dvec2 centre{0.0};           ///< barycentric weights, of the triangle's corners 1 and 2
  double area = 0;
  std::uint32_t parent = 0;  ///< of the union-find forest over all cuttings of a surface
};

/// A triangle's slices, by the texels that they come near to.
class TexelSlices {
 public:
  TexelSlices(const std::array<glm::dvec2, 3>& corners, int columns, int rows, const std::vector<Slice>& slices)
      : slices_(slices) {
    const auto inGrid = [&](const glm::dvec2& weights) {
      return corners[0] + weights.x * (corners[1] - corners[0]) + weights.y * (corners[2] - corners[0]);
    };
    for (std::uint32_t i = 0; i < slices.size(); ++i) {
      const glm::dvec2 a = inGrid(slices[i].from), b = inGrid(slices[i].to);
      const auto [firstRow, lastRow] = cells(std::min(a.y, b.y), std::max(a.y, b.y), rows);
      for (int row = firstRow; row <= lastRow; ++row) {
        const auto [low, high] = rangeInRow(a, b, row);
        const auto [firstColumn, lastColumn] = cells(low, high, columns);
        for (int column = firstColumn; column <= lastColumn; ++column)
          byTexel_[static_cast<std::uint32_t>(row * columns + column)].push_back(i);
      }
    }
  }

  /// Calls visit(slice) for those near a texel.
  template <typename Visit>
  void forEachNear(std::uint32_t texel, const Visit& visit) const {
    const auto found = byTexel_.find(texel);
    if (found == byTexel_.end()) return;
    for (const std::uint32_t slice : found->second) visit(slices_[slice]);
  }

 private:
  static constexpr double margin = 1e-6;  ///< in texels

  static std::pair<int, int> cells(double low, double high, int count) {
    const auto cell = [&](double place) { return std::clamp(static_cast<int>(std::floor(place)), 0, count - 1); };
    return {cell(low - margin), cell(high + margin)};
  }

  /// The columns' range of a segment within a row of texels.
  static std::pair<double, double> rangeInRow(const glm::dvec2& a, const glm::dvec2& b, int row) {
    const auto columnAt = [&](double y) {
      const double t = b.y == a.y ? 0 : std::clamp((y - a.y) / (b.y - a.y), 0.0, 1.0);
      return a.x + t * (b.x - a.x);
    };
    if (b.y == a.y) return std::minmax(a.x, b.x);
    return std::minmax({columnAt(row - margin), columnAt(row + 1 + margin)});
  }

  const std::vector<Slice>& slices_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> byTexel_;
};

/// Whether a slice lies between two points, given in the same weights. A line through the common end of two slices
/// meets one of them whatever the rounding: slices are taken for a millionth longer.
bool parts(const Slice& slice, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = slice.to - slice.from, step = b - a;
  const glm::dvec2 from = slice.from - 1e-6 * along, to = slice.to + 1e-6 * along;
  const double sideA = cross(along, a - from), sideB = cross(along, b - from);
  const double sideFrom = cross(step, from - a), sideTo = cross(step, to - a);
  return (sideA <= 0) != (sideB <= 0) && std::min(sideFrom, sideTo) <= 0 && std::max(sideFrom, sideTo) >= 0;
}

/// Both parts of a piece where a slice goes through it, the piece alone otherwise. `tolerance` is a length in weights.
std::vector<Piece> splitBy(const Piece& piece, const Slice& slice, double tolerance) {
  const glm::dvec2 along = slice.to - slice.from;
  const double length = glm::length(along);
  std::array<double, 12> distances{};
  double low = 0, high = 0, first = length, last = 0;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const double distance = cross(along, piece.corners[i].weight - slice.from) / length;
    distances[i] = std::abs(distance) <= tolerance ? 0 : distance;
    low = std::min(low, distances[i]);
    high = std::max(high, distances[i]);
  }
  if (low == 0 || high == 0) return {piece};
  const Halves halves = split(piece, distances);
  // The chord of the line through the piece, and what of it the slice covers.
  for (std::size_t i = 0; i < halves.below.size; ++i) {
    const PieceCorner& corner = halves.below.corners[i];
    const double side = cross(along, corner.weight - slice.from) / length;
    if (std::abs(side) > tolerance) continue;
    const double place = glm::dot(along, corner.weight - slice.from) / length;
    first = std::min(first, place);
    last = std::max(last, place);
  }
  if (std::min(last, length) - std::max(first, 0.0) <= tolerance) return {piece};
  std::vector<Piece> result;
  for (const Piece& half : {halves.below, halves.above}) {
    if (half.size <= 8) {
      result.push_back(half);
      continue;
    }
    const glm::dvec2 origin = half.corners[0].weight, diagonal = half.corners[half.size / 2].weight - origin;
    std::array<double, 12> fromDiagonal{};
    for (std::size_t i = 1; i < half.size; ++i)
      fromDiagonal[i] = i == half.size / 2 ? 0 : cross(diagonal, half.corners[i].weight - origin);
    const Halves quarters = split(half, fromDiagonal);
    result.push_back(quarters.below);
    result.push_back(quarters.above);
  }
  return result;
}

/// A surface cut by its slices, and the regions that its cuttings form.
class CutSurface {
 public:
  /// `slices` has an entry a triangle of the surface.
  CutSurface(const Scene& scene, std::uint32_t number, const Grid& grid, std::span<const std::vector<Slice>> slices)
      : surface_(scene.surfaces[number]), grid_(grid), tolerance_(eyeMove * scene.extent), extent_(scene.extent) {
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      slices_.emplace_back(inTexels(surface_.triangles[t], grid.columns, grid.rows), grid.columns, grid.rows, slices[t]);
      cut(t);
    }
    order_.resize(cuttings_.size());
    std::iota(order_.begin(), order_.end(), 0u);
    std::stable_sort(order_.begin(), order_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return cuttings_[a].texel < cuttings_[b].texel;
    });
    join();
  }

  /// By triangle.
  const std::vector<Cutting>& cuttings() const { return cuttings_; }
  /// Their numbers, by texel and triangle.
  const std::vector<std::uint32_t>& byTexel() const { return order_; }

  /// The cuttings of each region, the largest first.
  std::vector<std::vector<std::uint32_t>> regions() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> byRoot;
    for (std::uint32_t i = 0; i < cuttings_.size(); ++i) byRoot[rootOf(i)].push_back(i);
    std::vector<std::vector<std::uint32_t>> regions;
    for (auto& [root, region] : byRoot) {
      std::stable_sort(region.begin(), region.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return cuttings_[a].area > cuttings_[b].area; });
      regions.push_back(std::move(region));
    }
    return regions;
  }

 private:
  void cut(std::uint32_t triangle) {
    const std::array<glm::dvec2, 3> corners = inTexels(surface_.triangles[triangle], grid_.columns, grid_.rows);
    const double wholeArea = area(surface_.triangles[triangle]);
    const double tolerance = tolerance_ / std::sqrt(2 * wholeArea);
    forEachCell(corners, [&](std::int64_t column, std::int64_t row, const Piece& whole) {
      if (share(whole) <= smallestShare) return;
      const auto texel = static_cast<std::uint32_t>(texelOfCell(column, row, grid_.columns, grid_.rows));
      std::vector<Piece> pieces{whole};
      slices_[triangle].forEachNear(texel, [&](const Slice& slice) {
        std::vector<Piece> finer;
        for (const Piece& piece : pieces)
          for (const Piece& part : splitBy(piece, slice, tolerance))
            if (share(part) > smallestShare) finer.push_back(part);
        pieces = std::move(finer);
      });
      for (const Piece& piece : pieces)
        cuttings_.push_back({texel, triangle, pieces.size() > 1 ? std::optional(piece) : std::nullopt, centroid(piece),
                             share(piece) * wholeArea, static_cast<std::uint32_t>(cuttings_.size())});
    });
  }

  std::uint32_t rootOf(std::uint32_t cutting) {
    while (cuttings_[cutting].parent != cutting) {
      cuttings_[cutting].parent = cuttings_[cuttings_[cutting].parent].parent;
      cutting = cuttings_[cutting].parent;
    }
    return cutting;
  }

  void joinTwo(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t rootA = rootOf(a), rootB = rootOf(b);
    if (rootA != rootB && areConnected(a, b)) cuttings_[std::max(rootA, rootB)].parent = std::min(rootA, rootB);
  }

  /// Cuttings are of one region where no slice lies between their centres; of several triangles only in one plane.
  bool areConnected(std::uint32_t a, std::uint32_t b) const {
    const Cutting &one = cuttings_[a], &other = cuttings_[b];
    if (one.triangle == other.triangle) return areConnected(one.triangle, one, one.centre, other, other.centre);
    const std::optional<glm::dvec2> otherInOne = centreIn(one.triangle, other);
    const std::optional<glm::dvec2> oneInOther = centreIn(other.triangle, one);
    return otherInOne && oneInOther && areConnected(one.triangle, one, one.centre, other, *otherInOne) &&
           areConnected(other.triangle, one, *oneInOther, other, other.centre);
  }

  bool areConnected(std::uint32_t triangle, const Cutting& one, const glm::dvec2& from, const Cutting& other,
                    const glm::dvec2& to) const {
    bool isFree = true;
    const auto look = [&](const Slice& slice) { isFree = isFree && !parts(slice, from, to); };
    slices_[triangle].forEachNear(one.texel, look);
    if (other.texel != one.texel) slices_[triangle].forEachNear(other.texel, look);
    return isFree;
  }

  /// The centre of a cutting in the weights of another triangle; nothing where that lies in another plane.
  std::optional<glm::dvec2> centreIn(std::uint32_t triangle, const Cutting& cutting) const {
    const glm::dvec3 centre = pointOn(surface_, cutting.triangle, cutting.centre).position;
    const auto& [a, b, c] = surface_.triangles[triangle].position;
    const glm::dvec3 along1 = b - a, along2 = c - a, n = glm::cross(along1, along2), offset = centre - a;
    const double scale = glm::dot(n, n);
    if (glm::dot(n, normal(surface_.triangles[cutting.triangle])) < (1 - 1e-9) * std::sqrt(scale)) return std::nullopt;
    if (std::abs(glm::dot(n, offset)) > eyeLift * extent_ * std::sqrt(scale)) return std::nullopt;
    return glm::dvec2(glm::dot(glm::cross(offset, along2), n), glm::dot(glm::cross(along1, offset), n)) / scale;
  }

  /// Joins within texels, and with the texels right of and above each.
  void join() {
    std::vector<std::size_t> first(static_cast<std::size_t>(grid_.columns) * static_cast<std::size_t>(grid_.rows) + 1);
    for (const Cutting& cutting : cuttings_) ++first[cutting.texel + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    const auto in = [&](std::size_t texel) {
      return std::span(order_).subspan(first[texel], first[texel + 1] - first[texel]);
    };
    const auto columns = static_cast<std::size_t>(grid_.columns);
    for (std::size_t texel = 0; texel + 1 < first.size(); ++texel) {
      joinAll(in(texel), in(texel));
      if ((texel + 1) % columns != 0) joinAll(in(texel), in(texel + 1));
      if (texel + columns + 1 < first.size()) joinAll(in(texel), in(texel + columns));
    }
  }

  void joinAll(std::span<const std::uint32_t> some, std::span<const std::uint32_t> others) {
    const bool isPaired = some.size() * others.size() <= mostPaired * mostPaired;
    for (std::size_t i = 0; i < some.size(); ++i) {
      const std::size_t end = isPaired ? others.size() : std::min(others.size(), i + 2);
      for (std::size_t j = isPaired ? 0 : std::min(i, others.size()); j < end; ++j) joinTwo(some[i], others[j]);
    }
  }

  const Surface& surface_;
  const Grid& grid_;
  double tolerance_, extent_;
  std::vector<TexelSlices> slices_;  ///< one a triangle
  std::vector<Cutting> cuttings_;    ///< by triangle
  std::vector<std::uint32_t> order_;  ///< by texel
};

/// What a pixel of a region's hemicubes shows of a front.
struct Sighting {
  std::uint32_t surface = 0, texel = 0;
  glm::dvec3 eye{0.0}, direction{0.0};  ///< through the middle of the pixel; the scene's origin not subtracted
  double share = 0;                     ///< of the light that leaves the region
};

/// A region that may be buried.
struct Region {
  std::vector<Sighting> fronts;
  double backs = 0;  ///< share of the light that meets backs
  bool isBuried = true;
};

/// What a region sees through the pixels of hemicubes over some of its points.
class Lookout {
 public:
  Lookout(const Scene& scene, const Discretization& unburied)
      : scene_(scene),
        boxes_(triangleBoxes(scene)),
        layout_(layOut(unburied, {.format = "r32ui", .blend = raster::Blend::IntegerAdd, .aligned = false})),
        renderer_(softwareRenderer(makeDrawList(scene, unburied, layout_))),
        projection_(hemicube(resolution)) {}

  /// Adds what is seen from a point, which counts for `weight`.
  void look(std::uint32_t surface, const SurfacePoint& point, double weight, Region& region) {
    const glm::dvec3 eye = eyeOver(scene_, surface, point);
    const std::vector<std::uint32_t> skipped = skippedTriangles(scene_, boxes_, surface, point);
    const std::vector<raster::Face> faces =
        facesOver(projection_.faces, eye - scene_.origin, point.normal, glm::dvec3(0),
                  nearDistance(scene_, boxes_, eye, skipped, projection_.squaredReach));
    renderer_->draw(faces, skipped, buffers_);
    for (std::size_t f = 0; f < faces.size(); ++f)
      for (std::size_t pixel = 0; pixel < buffers_[f].words.size(); ++pixel)
        add(faces[f], f, pixel, eye, weight, region);
  }

 private:
  void add(const raster::Face& face, std::size_t number, std::size_t pixel, const glm::dvec3& eye, double weight,
           Region& region) const {
    const auto width = static_cast<std::size_t>(face.scissor.width);
    const int column = face.scissor.column + static_cast<int>(pixel % width);
    const int row = face.scissor.row + static_cast<int>(pixel / width);
    const double share = weight * formFactor(shareOf(projection_, number, column, row));
    const raster::Word word = buffers_[number].words[pixel];
    if (word == raster::backWord(layout_.format)) region.backs += share;
    const std::optional<PageIndex> seen = pageIndexOf(layout_, word);
    if (!seen) return;
    const glm::dvec2 place = (glm::dvec2(column, row) + 0.5) * (2.0 / face.resolution) - 1.0;
    const glm::dvec3 direction = place.x * glm::dvec3(face.x) + place.y * glm::dvec3(face.y) + glm::dvec3(face.w);
    region.fronts.push_back({seen->page, seen->index, eye, direction, share});
  }

  const Scene& scene_;
  std::vector<TriangleBox> boxes_;
  WordLayout layout_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  Projection projection_;
  std::vector<raster::ItemBuffer> buffers_;
};

/// The cuttings of a surface that has regions which may be buried.
struct DoubtfulSurface {
  std::vector<Cutting> cuttings;                       ///< by texel
  std::vector<std::optional<std::size_t>> regionOf;    ///< one a cutting; nothing where it is exposed for sure
};

/// Finds the regions that may be buried, and which of them are.
class BuriedRegions {
 public:
  BuriedRegions(const Scene& scene, const Discretization& unburied)
      : scene_(scene), unburied_(unburied), lookout_(scene, unburied) {}

  void add(std::uint32_t surface, CutSurface& cut) {
    std::vector<std::optional<std::size_t>> regionOf(cut.cuttings().size());
    bool isDoubtful = false;
    for (const std::vector<std::uint32_t>& cuttings : cut.regions()) {
      std::optional<Region> region = doubtfulRegion(surface, cut.cuttings(), cuttings);
      if (!region) continue;
      isDoubtful = true;
      for (const std::uint32_t cutting : cuttings) regionOf[cutting] = regions_.size();
      regions_.push_back(std::move(*region));
    }
    if (!isDoubtful) return;
    DoubtfulSurface& doubtful = surfaces_[surface];
    for (const std::uint32_t cutting : cut.byTexel()) {
      doubtful.cuttings.push_back(cut.cuttings()[cutting]);
      doubtful.regionOf.push_back(regionOf[cutting]);
    }
  }

  /// Takes out regions that see exposed fronts until none is left that does.
  void settle() {
    bool hasChanged = true;
    while (hasChanged) {
      hasChanged = false;
      for (Region& region : regions_) {
        if (!region.isBuried || !seesExposed(region)) continue;
        region.isBuried = false;
        hasChanged = true;
      }
    }
  }

  std::vector<std::vector<CutTexel>> cutTexels() const {
    std::vector<std::vector<CutTexel>> cut(scene_.surfaces.size());
    for (const auto& [number, surface] : surfaces_) {
      std::vector<CutTexel> texels;
      bool hasExposed = false;
      for (std::size_t first = 0, end = 0; first < surface.cuttings.size(); first = end) {
        const std::uint32_t texel = surface.cuttings[first].texel;
        CutTexel entry{texel};
        for (; end < surface.cuttings.size() && surface.cuttings[end].texel == texel; ++end)
          if (!isBuried(surface.regionOf[end])) entry.exposed.push_back(pieceOf(number, surface.cuttings[end]));
        hasExposed = hasExposed || !entry.exposed.empty();
        if (entry.exposed.size() < end - first) texels.push_back(std::move(entry));
      }
      if (hasExposed) cut[number] = std::move(texels);
    }
    return cut;
  }

 private:
  bool isBuried(const std::optional<std::size_t>& region) const { return region && regions_[*region].isBuried; }

  /// What is seen from some points of a region; nothing where no back is, or where the region emits and sees anything
  /// else.
  std::optional<Region> doubtfulRegion(std::uint32_t surface, const std::vector<Cutting>& all,
                                       const std::vector<std::uint32_t>& cuttings) {
    Region region;
    const std::size_t count = std::min(pointsOfRegion, cuttings.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Cutting& cutting = all[cuttings[i * cuttings.size() / count]];
      lookout_.look(surface, pointOn(scene_.surfaces[surface], cutting.triangle, cutting.centre),
                    1 / static_cast<double>(count), region);
      if (region.backs == 0) return std::nullopt;
    }
    const double fronts = std::accumulate(region.fronts.begin(), region.fronts.end(), 0.0,
                                          [](double sum, const Sighting& front) { return sum + front.share; });
    if (fronts > region.backs && !emissions(scene_, unburied_, surface).areZero()) return std::nullopt;
    return region;
  }

  bool seesExposed(const Region& region) const {
    double fronts = 0;
    for (const Sighting& front : region.fronts)
      if (!isBuried(regionAt(front))) fronts += front.share;
    return fronts >= leastExposed * (fronts + region.backs);
  }

  /// The region that a front belongs to: of the texel's cuttings the one that the line of sight passes, or passes
  /// nearest to.
  std::optional<std::size_t> regionAt(const Sighting& front) const {
    const auto surface = surfaces_.find(front.surface);
    if (surface == surfaces_.end()) return std::nullopt;
    const auto& [cuttings, regionOf] = surface->second;
    const auto first = std::lower_bound(cuttings.begin(), cuttings.end(), front.texel,
                                        [](const Cutting& c, std::uint32_t texel) { return c.texel < texel; });
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<std::size_t> region;
    for (auto c = first; c != cuttings.end() && c->texel == front.texel; ++c) {
      const double distance = distanceFrom(scene_.surfaces[front.surface].triangles[c->triangle], *c, front);
      if (c != first && distance >= nearest) continue;
      nearest = distance;
      region = regionOf[static_cast<std::size_t>(c - cuttings.begin())];
    }
    return region;
  }

  /// How far a line of sight passes outside of a cutting's piece, in weights; 0 inside.
  static double distanceFrom(const Triangle& triangle, const Cutting& cutting, const Sighting& front) {
    const auto& [a, b, c] = triangle.position;
    const glm::dvec3 along1 = b - a, along2 = c - a, n = glm::cross(along1, along2);
    const glm::dvec3 met = front.eye + glm::dot(n, a - front.eye) / glm::dot(n, front.direction) * front.direction - a;
    const double scale = glm::dot(n, n);
    const glm::dvec2 weights(glm::dot(glm::cross(met, along2), n) / scale, glm::dot(glm::cross(along1, met), n) / scale);
    if (!cutting.piece)
      return std::max({0.0, -weights.x, -weights.y, weights.x + weights.y - 1});
    const Piece& piece = *cutting.piece;
    double outside = 0;
    for (std::size_t i = 0; i < piece.size; ++i) {
      const glm::dvec2 from = piece.corners[i].weight, edge = piece.corners[(i + 1) % piece.size].weight - from;
      const double length = glm::length(edge);
      if (length > 0) outside = std::max(outside, -cross(edge, weights - from) / length);
    }
    return outside;
  }

  TexelPiece pieceOf(std::uint32_t surface, const Cutting& cutting) const {
    if (cutting.piece) return {cutting.triangle, *cutting.piece};
    const Grid& grid = unburied_.grids[surface];
    const auto columns = static_cast<std::uint32_t>(grid.columns);
    const auto corners = inTexels(scene_.surfaces[surface].triangles[cutting.triangle], grid.columns, grid.rows);
    return {cutting.triangle, clippedToCell(corners, cutting.texel % columns, cutting.texel / columns)};
  }

  const Scene& scene_;
  const Discretization& unburied_;
  Lookout lookout_;
  std::vector<Region> regions_;
  std::map<std::uint32_t, DoubtfulSurface> surfaces_;
};

}  // namespace

std::vector<std::vector<CutTexel>> cutTexels(const Scene& scene, const Discretization& unburied) {
  std::vector<std::vector<CutTexel>> none(scene.surfaces.size());
  if (std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& s) { return s.twin.has_value(); }))
    return none;
  const std::vector<std::vector<Slice>> slices = triangleSlices(scene);
  std::optional<BuriedRegions> regions;
  std::size_t first = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const auto ofSurface = std::span(slices).subspan(first, scene.surfaces[s].triangles.size());
    first += ofSurface.size();
    if (std::all_of(ofSurface.begin(), ofSurface.end(), [](const auto& some) { return some.empty(); })) continue;
    CutSurface cut(scene, s, unburied.grids[s], ofSurface);
    if (!regions) regions.emplace(scene, unburied);
    regions->add(s, cut);
  }
  if (!regions) return none;
  regions->settle();
  return regions->cutTexels();
}

}  // namespace hemitex::radiosity
