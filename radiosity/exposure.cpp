#include "radiosity/exposure.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "radiosity/drawn_rows.h"
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

/// Whether a slice lies between two points, given in the same weights.
bool parts(const Slice& slice, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = slice.to - slice.from, step = b - a;
  const double sideA = cross(along, a - slice.from), sideB = cross(along, b - slice.from);
  const double sideFrom = cross(step, slice.from - a), sideTo = cross(step, slice.to - a);
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

  const std::vector<Cutting>& cuttings() const { return cuttings_; }

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

/// Cuttings of a surface that may be buried together, and what is seen from there.
struct Region {
  std::uint32_t surface = 0;
  std::vector<Cutting> cuttings;
  FormFactorRow seen;
  bool isBuried = true;
};

/// What a texel has beside regions that may be buried.
struct Neighbours {
  std::uint32_t surface = 0;
  std::vector<Cutting> cuttings;
};

/// Finds the regions that may be buried, and which of them are.
class BuriedRegions {
 public:
  BuriedRegions(const Scene& scene, const Discretization& unburied)
      : scene_(scene),
        unburied_(unburied),
        layout_(layOut(unburied, {.format = "r32ui", .blend = raster::Blend::IntegerAdd, .aligned = false})),
        renderer_(softwareRenderer(makeDrawList(scene, unburied, layout_))),
        rows_(scene, unburied, layout_, *renderer_, {.resolution = resolution}) {}

  void add(std::uint32_t surface, CutSurface& cut) {
    std::vector<std::vector<std::uint32_t>> whole;
    bool hasCandidate = false;
    std::vector<Cutting> rest;
    for (const std::vector<std::uint32_t>& region : cut.regions()) {
      std::vector<Cutting> cuttings;
      for (const std::uint32_t c : region) cuttings.push_back(cut.cuttings()[c]);
      if (const auto seen = seenFrom(surface, cuttings)) {
        regions_.push_back({surface, std::move(cuttings), *seen});
        hasCandidate = true;
      } else {
        rest.insert(rest.end(), cuttings.begin(), cuttings.end());
      }
    }
    if (hasCandidate) rest_.push_back({surface, std::move(rest)});
  }

  /// Takes out regions that see exposed fronts until none is left that does.
  void settle() {
    for (const Region& region : regions_) count(region, 1);
    bool hasChanged = true;
    while (hasChanged) {
      hasChanged = false;
      for (Region& region : regions_) {
        if (!region.isBuried || !seesExposed(region)) continue;
        region.isBuried = false;
        count(region, -1);
        hasChanged = true;
      }
    }
  }

  std::vector<std::vector<CutTexel>> cutTexels() const {
    std::vector<std::vector<CutTexel>> cut(scene_.surfaces.size());
    for (const Neighbours& neighbours : rest_) {
      std::map<std::uint32_t, std::vector<Cutting>> exposedIn;
      std::vector<const Region*> own;
      for (const Region& region : regions_)
        if (region.surface == neighbours.surface) own.push_back(&region);
      for (const Region* region : own)
        if (region->isBuried)
          for (const Cutting& cutting : region->cuttings) exposedIn[cutting.texel];
      const auto keep = [&](const std::vector<Cutting>& cuttings) {
        for (const Cutting& cutting : cuttings)
          if (const auto found = exposedIn.find(cutting.texel); found != exposedIn.end())
            found->second.push_back(cutting);
      };
      bool hasExposed = !neighbours.cuttings.empty();
      keep(neighbours.cuttings);
      for (const Region* region : own) {
        if (region->isBuried) continue;
        keep(region->cuttings);
        hasExposed = true;
      }
      if (!hasExposed) continue;
      for (auto& [texel, cuttings] : exposedIn)
        cut[neighbours.surface].push_back({texel, piecesOf(neighbours.surface, texel, cuttings)});
    }
    return cut;
  }

 private:
  /// The mean of what is seen from some points of a region; nothing where no back is, or where the region emits and
  /// sees anything else.
  std::optional<FormFactorRow> seenFrom(std::uint32_t surface, const std::vector<Cutting>& cuttings) {
    std::vector<WeightedRow> rows;
    const std::size_t count = std::min(pointsOfRegion, cuttings.size());
    for (std::size_t i = 0; i < count; ++i) {
      const Cutting& cutting = cuttings[i * cuttings.size() / count];
      rows.push_back({rows_.from(surface, pointOn(scene_.surfaces[surface], cutting.triangle, cutting.centre)), 1});
      if (rows.size() == 1 && rows.front().row.back == 0) return std::nullopt;
    }
    FormFactorRow mean = meanOf(rows);
    if (!emissions(scene_, unburied_, surface).areZero() && sum(mean.shares) > mean.back) return std::nullopt;
    return mean;
  }

  static std::uint64_t sum(const std::vector<std::uint64_t>& shares) {
    return std::accumulate(shares.begin(), shares.end(), std::uint64_t{0});
  }

  /// Counts the area of a region into what is buried of its elements, or out of it.
  void count(const Region& region, int sign) {
    const Grid& grid = unburied_.grids[region.surface];
    for (const Cutting& cutting : region.cuttings) buriedArea_[grid.spill[cutting.texel]] += sign * cutting.area;
  }

  bool seesExposed(const Region& region) const {
    double fronts = 0;
    for (std::size_t i = 0; i < region.seen.elements.size(); ++i) {
      const std::uint32_t element = region.seen.elements[i];
      const auto buried = buriedArea_.find(element);
      const double share = buried == buriedArea_.end() ? 0 : buried->second / unburied_.elements[element].area;
      fronts += formFactor(region.seen.shares[i]) * std::clamp(1 - share, 0.0, 1.0);
    }
    return fronts >= leastExposed * (fronts + formFactor(region.seen.back));
  }

  /// The exposed pieces of a texel, by triangle.
  std::vector<TexelPiece> piecesOf(std::uint32_t surface, std::uint32_t texel, std::vector<Cutting>& cuttings) const {
    std::stable_sort(cuttings.begin(), cuttings.end(),
                     [](const Cutting& a, const Cutting& b) { return a.triangle < b.triangle; });
    const Grid& grid = unburied_.grids[surface];
    std::vector<TexelPiece> pieces;
    for (const Cutting& cutting : cuttings) {
      const auto columns = static_cast<std::uint32_t>(grid.columns);
      const auto corners = inTexels(scene_.surfaces[surface].triangles[cutting.triangle], grid.columns, grid.rows);
      pieces.push_back({cutting.triangle, cutting.piece
                                              ? *cutting.piece
                                              : clippedToCell(corners, texel % columns, texel / columns)});
    }
    return pieces;
  }

  const Scene& scene_;
  const Discretization& unburied_;
  WordLayout layout_;
  std::unique_ptr<raster::ItemBufferRenderer> renderer_;
  ProjectedRows rows_;
  std::vector<Region> regions_;
  std::vector<Neighbours> rest_;  ///< of the surfaces that have regions which may be buried
  std::map<std::uint32_t, double> buriedArea_;  ///< by element
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
