#include "radiosity/exposure.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <utility>

#include "radiosity/neighbours.h"
#include "radiosity/projection.h"
#include "radiosity/ray_tree.h"
#include "radiosity/shooting_view.h"
#include "radiosity/texel_areas.h"
#include "radiosity/triangle_slices.h"
#include "raster/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Pixels along the side of the hemicubes that say what a region sees, one ray each.
constexpr int resolution = 6;
/// Points of a region that look.
constexpr int pointsOfRegion = 4;
/// A region is exposed where exposed fronts are at least this share of all exposed fronts and backs that it sees.
constexpr double leastExposed = 0.1;
/// It also is where lights are at least this share of what it sees: light gets there, whatever stands around.
constexpr double leastLights = 0.005;
/// Neighbours of a surface belong together up to this fold: the cosine of the angle between their normals.
constexpr double leastCosine = 0.7;
/// Faces touch that face each other, to this cosine of the angle between them.
constexpr double touchingCosine = 0.999;
/// Relative to the area of its triangle; a smaller piece is rounding noise.
constexpr double smallestShare = 1e-14;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// The part of a triangle in a texel, or one of the pieces that slices cut it into.
struct Cutting {
  std::uint32_t texel = 0, triangle = 0;
  std::shared_ptr<const Piece> piece = {};  ///< where there are several in the texel
  glm::dvec2 centre{0.0};                   ///< barycentric weights, of the triangle's corners 1 and 2
  double area = 0;
  std::uint32_t parent = 0;  ///< of the union-find forest over all cuttings of a surface
};

/// A range along a line.
struct Range {
  double low = 0, high = 0;
};

/// What of a range other ranges leave uncovered.
double uncovered(const Range& range, std::vector<Range>& covers) {
  std::sort(covers.begin(), covers.end(), [](const Range& a, const Range& b) { return a.low < b.low; });
  double left = 0, end = range.low;
  for (const Range& cover : covers) {
    left += std::max(0.0, std::min(cover.low, range.high) - end);
    end = std::max(end, std::min(cover.high, range.high));
  }
  return left + range.high - end;
}

/// What of a range along a line a segment covers that lies along it. The segment's ends are given as the place along
/// the line and the distance from it.
std::optional<Range> coverOf(const Range& range, glm::dvec2 from, glm::dvec2 to, double distance) {
  if (from.x > to.x) std::swap(from, to);
  const double low = std::max(range.low, from.x), high = std::min(range.high, to.x);
  if (low >= high) return std::nullopt;
  const double slope = (to.y - from.y) / (to.x - from.x);
  const auto isNear = [&](double place) { return std::abs(from.y + slope * (place - from.x)) <= distance; };
  if (!isNear(low) || !isNear(high)) return std::nullopt;
  return Range{low, high};
}

namespace index = boost::geometry::index;
using BoostPoint = boost::geometry::model::point<double, 2, boost::geometry::cs::cartesian>;
using BoostBox = boost::geometry::model::box<BoostPoint>;

BoostBox boxAround(const glm::dvec2& a, const glm::dvec2& b, double margin) {
  const glm::dvec2 low = glm::min(a, b) - margin, high = glm::max(a, b) + margin;
  return {{low.x, low.y}, {high.x, high.y}};
}

/// Segments in the plane of a triangle, found by where they are.
class SegmentTree {
 public:
  /// Segments so near to a box are found.
  SegmentTree(const std::vector<Slice>& segments, double margin) : margin_(margin) {
    std::vector<std::pair<BoostBox, std::uint32_t>> boxes;
    boxes.reserve(segments.size());
    for (std::uint32_t i = 0; i < segments.size(); ++i)
      boxes.emplace_back(boxAround(segments[i].from, segments[i].to, 0), i);
    tree_ = Tree(boxes);
  }

  /// The numbers of those near the box around two points, ascending.
  const std::vector<std::uint32_t>& near(const glm::dvec2& low, const glm::dvec2& high) {
    found_.clear();
    for (auto it = tree_.qbegin(index::intersects(boxAround(low, high, margin_))); it != tree_.qend(); ++it)
      found_.push_back(it->second);
    std::sort(found_.begin(), found_.end());
    return found_;
  }

 private:
  using Tree = index::rtree<std::pair<BoostBox, std::uint32_t>, index::quadratic<16>>;

  double margin_;
  Tree tree_;
  std::vector<std::uint32_t> found_;
};

/// The plane of a triangle, in lengths.
struct TrianglePlane {
  glm::dmat2 axes;  ///< what weights are multiplied with

  explicit TrianglePlane(const Triangle& triangle) {
    const glm::dvec3 along1 = triangle.position[1] - triangle.position[0],
                     along2 = triangle.position[2] - triangle.position[0];
    const double length = glm::length(along1);
    axes = {{length, 0}, {glm::dot(along1, along2) / length, glm::length(glm::cross(along1, along2)) / length}};
  }

  glm::dvec2 place(const glm::dvec2& weights) const { return axes * weights; }
};

/// Both parts of a piece where a slice goes through it, the piece alone otherwise. The slice is given in the plane.
std::vector<Piece> splitBy(const Piece& piece, const TrianglePlane& plane, const Slice& slice, double tolerance) {
  const glm::dvec2 along = slice.to - slice.from;
  const double length = glm::length(along);
  std::array<double, 12> distances{};
  double low = 0, high = 0, first = length, last = 0;
  for (std::size_t i = 0; i < piece.size; ++i) {
    const double distance = cross(along, plane.place(piece.corners[i].weight) - slice.from) / length;
    distances[i] = std::abs(distance) <= tolerance ? 0 : distance;
    low = std::min(low, distances[i]);
    high = std::max(high, distances[i]);
  }
  if (low == 0 || high == 0) return {piece};
  const Halves halves = split(piece, distances);
  // The chord of the line through the piece, and what of it the slice covers.
  for (std::size_t i = 0; i < halves.below.size; ++i) {
    const PieceCorner& corner = halves.below.corners[i];
    const glm::dvec2 offset = plane.place(corner.weight) - slice.from;
    if (std::abs(cross(along, offset) / length) > tolerance) continue;
    const double place = glm::dot(along, offset) / length;
    first = std::min(first, place);
    last = std::max(last, place);
  }
  // Pieces may be narrower than the tolerance.
  if (std::min(last, length) - std::max(first, 0.0) <= std::min(tolerance, (last - first) / 2)) return {piece};
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

/// Whether two segments share a part of a line that no slice lies along.
bool areJoined(const Slice& one, const Slice& other, const std::vector<Slice>& slices, SegmentTree& tree,
               double tolerance) {
  const bool isOneLonger = glm::length(one.to - one.from) >= glm::length(other.to - other.from);
  const Slice &line = isOneLonger ? one : other, &beside = isOneLonger ? other : one;
  const double length = glm::length(line.to - line.from);
  const glm::dvec2 along = (line.to - line.from) / length;
  const auto onLine = [&](const glm::dvec2& point) {
    return glm::dvec2(glm::dot(along, point - line.from), cross(along, point - line.from));
  };
  const glm::dvec2 from = onLine(beside.from), to = onLine(beside.to);
  if (std::max(std::abs(from.y), std::abs(to.y)) > 2 * tolerance) return false;
  const Range range{std::max(0.0, std::min(from.x, to.x)), std::min(length, std::max(from.x, to.x))};
  if (range.high - range.low <= 4 * tolerance) return false;
  std::vector<Range> covers;
  for (const std::uint32_t slice : tree.near(line.from + range.low * along, line.from + range.high * along))
    if (const auto cover = coverOf(range, onLine(slices[slice].from), onLine(slices[slice].to), 2 * tolerance))
      covers.push_back(*cover);
  return uncovered(range, covers) > 4 * tolerance;
}

bool contains(const Piece& piece, const glm::dvec2& weights) {
  for (std::size_t i = 0; i < piece.size; ++i) {
    const glm::dvec2 corner = piece.corners[i].weight;
    if (cross(piece.corners[(i + 1) % piece.size].weight - corner, weights - corner) < 0) return false;
  }
  return true;
}

/// What of a triangle's edge belongs to which cutting, in lengths from the edge's first corner.
struct EdgePart {
  Range range;
  std::uint32_t cutting = 0;
};

/// A surface cut by its slices, and the regions that its cuttings form: those that share a part of their borders that
/// no slice lies along.
class CutSurface {
 public:
  /// `slices` has an entry a triangle of the surface.
  CutSurface(const Scene& scene, std::uint32_t number, const Grid& grid, std::span<const std::vector<Slice>> slices)
      : surface_(scene.surfaces[number]), grid_(grid), slices_(slices), tolerance_(eyeMove * scene.extent) {
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      first_.push_back(static_cast<std::uint32_t>(cuttings_.size()));
      if (slices[t].empty())
        cutWhole(t);
      else
        cut(t);
    }
    first_.push_back(static_cast<std::uint32_t>(cuttings_.size()));
    joinTriangles();
  }

  const std::vector<Cutting>& cuttings() const { return cuttings_; }

  /// The cutting that a point of a triangle lies in; the triangle's first where rounding puts it in none.
  std::uint32_t cuttingAt(std::uint32_t triangle, const glm::dvec2& weights) const {
    const std::uint32_t first = first_[triangle], end = first_[triangle + 1];
    if (slices_[triangle].empty()) return first;
    const auto [a, b, c] = inTexels(surface_.triangles[triangle], grid_.columns, grid_.rows);
    const glm::dvec2 place = a + weights.x * (b - a) + weights.y * (c - a);
    const std::uint32_t texel =
        texelAt(static_cast<std::int64_t>(std::floor(place.x)), static_cast<std::int64_t>(std::floor(place.y)));
    for (std::uint32_t i = first; i < end; ++i)
      if (cuttings_[i].texel == texel && (!cuttings_[i].piece || contains(*cuttings_[i].piece, weights))) return i;
    return first;
  }

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
  using Edges = std::array<std::vector<EdgePart>, 3>;  ///< by the opposite corner

  std::uint32_t texelAt(std::int64_t column, std::int64_t row) const {
    return static_cast<std::uint32_t>(texelOfCell(column, row, grid_.columns, grid_.rows));
  }

  void add(std::uint32_t texel, std::uint32_t triangle, const Piece& piece, double wholeArea) {
    cuttings_.push_back({texel, triangle, nullptr, centroid(piece), share(piece) * wholeArea,
                         static_cast<std::uint32_t>(cuttings_.size())});
  }

  /// A triangle without slices is of one region.
  void cutWhole(std::uint32_t triangle) {
    const double wholeArea = area(surface_.triangles[triangle]);
    forEachCell(inTexels(surface_.triangles[triangle], grid_.columns, grid_.rows),
                [&](std::int64_t column, std::int64_t row, const Piece& whole) {
                  if (share(whole) <= smallestShare) return;
                  add(texelAt(column, row), triangle, whole, wholeArea);
                  cuttings_.back().parent = first_[triangle];
                });
  }

  void cut(std::uint32_t triangle) {
    const double wholeArea = area(surface_.triangles[triangle]);
    const TrianglePlane plane(surface_.triangles[triangle]);
    std::vector<Slice> slices;
    for (const Slice& slice : slices_[triangle]) slices.push_back({plane.place(slice.from), plane.place(slice.to)});
    SegmentTree tree(slices, 2 * tolerance_);
    std::vector<Slice> borders;
    std::vector<std::uint32_t> owners;
    forEachCell(
        inTexels(surface_.triangles[triangle], grid_.columns, grid_.rows),
        [&](std::int64_t column, std::int64_t row, const Piece& whole) {
          if (share(whole) <= smallestShare) return;
          const std::vector<Piece> pieces = piecesOf(whole, plane, slices, tree);
          for (const Piece& piece : pieces) {
            add(texelAt(column, row), triangle, piece, wholeArea);
            if (pieces.size() > 1) cuttings_.back().piece = std::make_shared<const Piece>(piece);
            for (std::size_t i = 0; i < piece.size; ++i) {
              const std::size_t next = (i + 1) % piece.size;
              borders.push_back({plane.place(piece.corners[i].weight), plane.place(piece.corners[next].weight)});
              owners.push_back(static_cast<std::uint32_t>(cuttings_.size() - 1));
            }
          }
        });
    joinAlong(borders, owners, slices, tree);
    edges_[triangle] = edgesOf(triangle, borders, owners);
  }

  /// What the slices cut a piece into.
  std::vector<Piece> piecesOf(const Piece& whole, const TrianglePlane& plane, const std::vector<Slice>& slices,
                              SegmentTree& tree) const {
    glm::dvec2 low = plane.place(whole.corners[0].weight), high = low;
    for (std::size_t i = 1; i < whole.size; ++i) {
      low = glm::min(low, plane.place(whole.corners[i].weight));
      high = glm::max(high, plane.place(whole.corners[i].weight));
    }
    std::vector<Piece> pieces{whole};
    for (const std::uint32_t slice : tree.near(low, high)) {
      // Parts replace the piece or go to the end, where this slice does not come to them.
      const std::size_t count = pieces.size();
      for (std::size_t i = 0; i < count; ++i) {
        if (!mayCut(slices[slice], plane, pieces[i])) continue;
        std::vector<Piece> parts = splitBy(pieces[i], plane, slices[slice], tolerance_);
        std::erase_if(parts, [](const Piece& part) { return share(part) <= smallestShare; });
        if (parts.empty()) continue;
        pieces[i] = parts.front();
        pieces.insert(pieces.end(), parts.begin() + 1, parts.end());
      }
    }
    return pieces;
  }

  /// Whether the boxes around both meet.
  static bool mayCut(const Slice& slice, const TrianglePlane& plane, const Piece& piece) {
    bool isLeft = true, isRight = true, isBelow = true, isAbove = true;
    const glm::dvec2 low = glm::min(slice.from, slice.to), high = glm::max(slice.from, slice.to);
    for (std::size_t i = 0; i < piece.size; ++i) {
      const glm::dvec2 corner = plane.place(piece.corners[i].weight);
      isLeft = isLeft && corner.x < low.x;
      isRight = isRight && corner.x > high.x;
      isBelow = isBelow && corner.y < low.y;
      isAbove = isAbove && corner.y > high.y;
    }
    return !isLeft && !isRight && !isBelow && !isAbove;
  }

  std::uint32_t rootOf(std::uint32_t cutting) {
    while (cuttings_[cutting].parent != cutting) {
      cuttings_[cutting].parent = cuttings_[cuttings_[cutting].parent].parent;
      cutting = cuttings_[cutting].parent;
    }
    return cutting;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t rootA = rootOf(a), rootB = rootOf(b);
    cuttings_[std::max(rootA, rootB)].parent = std::min(rootA, rootB);
  }

  /// Joins the cuttings of one triangle.
  void joinAlong(const std::vector<Slice>& borders, const std::vector<std::uint32_t>& owners,
                 const std::vector<Slice>& slices, SegmentTree& tree) {
    SegmentTree others(borders, tolerance_);
    for (std::uint32_t i = 0; i < borders.size(); ++i)
      for (const std::uint32_t j : others.near(borders[i].from, borders[i].to))
        if (j > i && rootOf(owners[i]) != rootOf(owners[j]) &&
            areJoined(borders[i], borders[j], slices, tree, tolerance_))
          join(owners[i], owners[j]);
  }

  /// Lengths that a point's barycentric weights stand for: along an edge, and over it.
  struct EdgeFrame {
    std::size_t opposite;
    double length, height;

    EdgeFrame(const Triangle& triangle, std::size_t corner)
        : opposite(corner),
          length(glm::distance(triangle.position[(corner + 1) % 3], triangle.position[(corner + 2) % 3])),
          height(2 * area(triangle) / length) {}

    glm::dvec2 place(const glm::dvec2& weights) const {
      const std::array<double, 3> all{1 - weights.x - weights.y, weights.x, weights.y};
      return {all[(opposite + 2) % 3] * length, all[opposite] * height};
    }
  };

  /// `borders` are given in the plane of the triangle.
  Edges edgesOf(std::uint32_t triangle, const std::vector<Slice>& borders,
                const std::vector<std::uint32_t>& owners) const {
    const TrianglePlane plane(surface_.triangles[triangle]);
    const std::array<glm::dvec2, 3> corners{glm::dvec2(0), plane.axes[0], plane.axes[1]};
    Edges edges;
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec2 start = corners[(k + 1) % 3], along = glm::normalize(corners[(k + 2) % 3] - start);
      for (std::size_t i = 0; i < borders.size(); ++i) {
        const glm::dvec2 from = borders[i].from - start, to = borders[i].to - start;
        if (std::max(std::abs(cross(along, from)), std::abs(cross(along, to))) > tolerance_) continue;
        const double first = glm::dot(along, from), last = glm::dot(along, to);
        edges[k].push_back({{std::min(first, last), std::max(first, last)}, owners[i]});
      }
    }
    return edges;
  }

  std::vector<EdgePart> edgeParts(std::uint32_t triangle, const EdgeFrame& frame) const {
    const auto found = edges_.find(triangle);
    if (found != edges_.end()) return found->second[frame.opposite];
    return {{{0, frame.length}, first_[triangle]}};
  }

  /// Slices that lie along a part of an edge; `isReversed` where places count from its other end.
  void addCovers(std::uint32_t triangle, const EdgeFrame& frame, bool isReversed, const Range& range,
                 std::vector<Range>& covers) const {
    for (const Slice& slice : slices_[triangle]) {
      glm::dvec2 from = frame.place(slice.from), to = frame.place(slice.to);
      if (isReversed) {
        from.x = frame.length - from.x;
        to.x = frame.length - to.x;
      }
      if (const auto cover = coverOf(range, from, to, 2 * tolerance_)) covers.push_back(*cover);
    }
  }

  /// Joins cuttings across the edges that triangles share, but where the surface folds sharply.
  void joinTriangles() {
    const auto across = neighbours(surface_);
    std::vector<glm::dvec3> normals;
    for (const Triangle& triangle : surface_.triangles) normals.push_back(normal(triangle));
    for (std::uint32_t t = 0; t < across.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = across[t][k];
        if (other == noNeighbour || hasNone(t) || hasNone(other)) continue;
        if (glm::dot(normals[t], normals[other]) < leastCosine) continue;
        if (slices_[t].empty() && slices_[other].empty())
          join(first_[t], first_[other]);
        else if (t < other || slices_[other].empty())
          joinAcross(t, k, other);
      }
  }

  bool hasNone(std::uint32_t triangle) const { return first_[triangle] == first_[triangle + 1]; }

  void joinAcross(std::uint32_t triangle, std::size_t corner, std::uint32_t other) {
    const Triangle &here = surface_.triangles[triangle], &there = surface_.triangles[other];
    const EdgeFrame frame(here, corner), otherFrame(there, oppositeCorner(here, corner, there));
    const bool isReversed = here.position[(corner + 1) % 3] != there.position[(otherFrame.opposite + 1) % 3];
    for (EdgePart& part : edgeParts(other, otherFrame)) {
      if (isReversed) part.range = {frame.length - part.range.high, frame.length - part.range.low};
      for (const EdgePart& own : edgeParts(triangle, frame)) {
        const Range range{std::max(own.range.low, part.range.low), std::min(own.range.high, part.range.high)};
        if (range.high - range.low <= 4 * tolerance_ || rootOf(own.cutting) == rootOf(part.cutting)) continue;
        std::vector<Range> covers;
        addCovers(triangle, frame, false, range, covers);
        addCovers(other, otherFrame, isReversed, range, covers);
        if (uncovered(range, covers) > 4 * tolerance_) join(own.cutting, part.cutting);
      }
    }
  }

  const Surface& surface_;
  const Grid& grid_;
  std::span<const std::vector<Slice>> slices_;  ///< one entry a triangle
  double tolerance_;
  std::vector<Cutting> cuttings_;         ///< by triangle
  std::vector<std::uint32_t> first_;      ///< of each triangle's cuttings, and behind the last
  std::map<std::uint32_t, Edges> edges_;  ///< of the triangles that have slices
};

/// Cuttings of a surface that are exposed or buried together.
struct Region {
  std::uint32_t surface = 0;
  std::vector<std::uint32_t> cuttings = {};  ///< the largest first
  bool isBuried = false;
};

/// What is seen from a region, as form factors.
struct Seen {
  double backs = 0, exposedFronts = 0;
  double lights = 0;                             ///< of the exposed fronts those that emit
  std::size_t points = 0;                        ///< that it is seen from; shares are their sums
  std::map<std::uint32_t, double> regions = {};  ///< fronts, by region
};

/// A direction over a surface, z along its normal, and the form factor that it stands for.
struct LookDirection {
  glm::dvec3 direction;
  double share;
};

/// The pixels' centres of a hemicube.
std::vector<LookDirection> lookDirections() {
  std::vector<LookDirection> directions;
  double sum = 0;
  const auto add = [&](const glm::dvec3& direction) {
    const double square = glm::dot(direction, direction), share = direction.z / (square * square);
    directions.push_back({direction, share});
    sum += share;
  };
  const auto at = [](int i) { return (2 * i + 1.0) / resolution - 1; };
  for (int j = 0; j < resolution; ++j)
    for (int i = 0; i < resolution; ++i) {
      add({at(i), at(j), 1});
      if (at(j) < 0) continue;
      for (const double side : {-1.0, 1.0}) {
        add({side, at(i), at(j)});
        add({at(i), side, at(j)});
      }
    }
  for (LookDirection& direction : directions) direction.share /= sum;
  return directions;
}

/// Finds which regions are buried.
class BuriedRegions {
 public:
  /// `slices` has an entry a triangle of the scene.
  BuriedRegions(const Scene& scene, const Discretization& unburied, const std::vector<std::vector<Slice>>& slices,
                const RayTree& rays)
      : scene_(scene), unburied_(unburied), cut_(scene.surfaces.size()), regionOf_(scene.surfaces.size()), rays_(rays) {
    cutSurfaces(slices);
    std::vector<std::optional<Seen>> seen(regions_.size());
    raster::parallelFor(regions_.size(), [&](std::size_t r) { seen[r] = seenFrom(regions_[r]); });
    for (std::size_t r = 0; r < regions_.size(); ++r) regions_[r].isBuried = seen[r].has_value();
    settle(seen);
  }

  std::vector<CutTexel> cutTexels(std::uint32_t surface) const {
    std::vector<CutTexel> cut;
    if (!cut_[surface]) return cut;
    std::map<std::uint32_t, std::vector<Cutting>> exposedIn;
    bool hasExposed = false;
    const std::vector<Cutting>& cuttings = cut_[surface]->cuttings();
    for (std::size_t c = 0; c < cuttings.size(); ++c)
      if (regions_[regionOf_[surface][c]].isBuried) exposedIn[cuttings[c].texel];
    for (std::size_t c = 0; c < cuttings.size(); ++c) {
      if (regions_[regionOf_[surface][c]].isBuried) continue;
      hasExposed = true;
      if (const auto found = exposedIn.find(cuttings[c].texel); found != exposedIn.end())
        found->second.push_back(cuttings[c]);
    }
    if (!hasExposed) return cut;
    for (auto& [texel, some] : exposedIn) cut.push_back({texel, piecesOf(surface, texel, some)});
    return cut;
  }

 private:
  void cutSurfaces(const std::vector<std::vector<Slice>>& slices) {
    std::vector<std::size_t> first{0};
    for (const Surface& surface : scene_.surfaces) first.push_back(first.back() + surface.triangles.size());
    std::vector<std::vector<std::vector<std::uint32_t>>> regions(scene_.surfaces.size());
    raster::parallelFor(scene_.surfaces.size(), [&](std::size_t s) {
      const auto own = std::span(slices).subspan(first[s], first[s + 1] - first[s]);
      if (std::all_of(own.begin(), own.end(), [](const auto& some) { return some.empty(); })) return;
      cut_[s].emplace(scene_, static_cast<std::uint32_t>(s), unburied_.grids[s], own);
      regions[s] = cut_[s]->regions();
    });
    for (std::uint32_t s = 0; s < regions.size(); ++s) {
      if (cut_[s]) regionOf_[s].resize(cut_[s]->cuttings().size());
      for (std::vector<std::uint32_t>& cuttings : regions[s]) {
        for (const std::uint32_t cutting : cuttings)
          regionOf_[s][cutting] = static_cast<std::uint32_t>(regions_.size());
        regions_.push_back({s, std::move(cuttings)});
      }
    }
  }

  /// The mean of what is seen from some points of a region; nothing where no back is, or where the region emits and
  /// sees anything else.
  std::optional<Seen> seenFrom(const Region& region) const {
    Seen seen;
    for (const std::uint32_t number : somePoints(region)) {
      const Cutting& cutting = cut_[region.surface]->cuttings()[number];
      look(region.surface, pointOn(scene_.surfaces[region.surface], cutting.triangle, cutting.centre), seen);
      if (seen.backs == 0) return std::nullopt;
    }
    const bool seesFronts = seen.exposedFronts > 0 || !seen.regions.empty();
    if (seesFronts && !emissions(scene_, unburied_, region.surface).areZero()) return std::nullopt;
    return seen;
  }

  /// The largest cutting of a region and some more, evenly by area: slivers lie too near to outlines to look from.
  std::vector<std::uint32_t> somePoints(const Region& region) const {
    const std::vector<Cutting>& cuttings = cut_[region.surface]->cuttings();
    double whole = 0, before = 0;
    for (const std::uint32_t c : region.cuttings) whole += cuttings[c].area;
    std::vector<std::uint32_t> some;
    for (const std::uint32_t c : region.cuttings) {
      if (before >= static_cast<double>(some.size()) / pointsOfRegion * whole) some.push_back(c);
      before += cuttings[c].area;
    }
    return some;
  }

  void look(std::uint32_t surface, const SurfacePoint& point, Seen& seen) const {
    const glm::dvec3 eye = eyeOver(scene_, surface, point);
    ++seen.points;
    // A face that touches another looks into the solid behind that one, or out of the scene.
    const double lift = eyeLift * scene_.extent;
    if (rays_.meetsBack(eye, -point.normal, 2 * lift, touchingCosine)) seen.backs += 1;
    const glm::dvec3 x = tangentAlong(point.normal, glm::dvec3(0)), y = glm::cross(point.normal, x);
    for (const LookDirection& look : directions_) {
      const auto hit = rays_.firstHit(eye, glm::dmat3(x, y, point.normal) * look.direction);
      if (!hit) continue;
      if (!hit->isFront)
        seen.backs += look.share;
      else if (!cut_[hit->surface])
        addExposed(hit->surface, look.share, seen);
      else
        seen.regions[regionOf_[hit->surface][cut_[hit->surface]->cuttingAt(hit->triangle, hit->weights)]] += look.share;
    }
  }

  void addExposed(std::uint32_t surface, double share, Seen& seen) const {
    seen.exposedFronts += share;
    if (!emissions(scene_, unburied_, surface).areZero()) seen.lights += share;
  }

  /// Takes out regions that see exposed fronts until none is left that does.
  void settle(const std::vector<std::optional<Seen>>& seen) {
    const auto seesExposed = [&](const Seen& view) {
      Seen all = view;
      for (const auto& [region, share] : view.regions)
        if (!regions_[region].isBuried) addExposed(regions_[region].surface, share, all);
      return all.exposedFronts >= leastExposed * (all.exposedFronts + all.backs) ||
             all.lights >= leastLights * static_cast<double>(all.points);
    };
    bool hasChanged = true;
    while (hasChanged) {
      hasChanged = false;
      for (std::size_t r = 0; r < regions_.size(); ++r) {
        if (!regions_[r].isBuried || !seesExposed(*seen[r])) continue;
        regions_[r].isBuried = false;
        hasChanged = true;
      }
    }
  }

  /// The exposed pieces of a texel, by triangle.
  std::vector<TexelPiece> piecesOf(std::uint32_t surface, std::uint32_t texel,
                                   const std::vector<Cutting>& cuttings) const {
    const Grid& grid = unburied_.grids[surface];
    const auto columns = static_cast<std::uint32_t>(grid.columns);
    std::vector<TexelPiece> pieces;
    for (const Cutting& cutting : cuttings) {
      const auto corners = inTexels(scene_.surfaces[surface].triangles[cutting.triangle], grid.columns, grid.rows);
      pieces.push_back({cutting.triangle,
                        cutting.piece ? *cutting.piece : clippedToCell(corners, texel % columns, texel / columns)});
    }
    return pieces;
  }

  const Scene& scene_;
  const Discretization& unburied_;
  std::vector<std::optional<CutSurface>> cut_;        ///< of surfaces that have slices
  std::vector<std::vector<std::uint32_t>> regionOf_;  ///< of each cutting, by surface
  const RayTree& rays_;
  std::vector<LookDirection> directions_ = lookDirections();
  std::vector<Region> regions_;
};

}  // namespace

std::vector<std::vector<CutTexel>> cutTexels(const Scene& scene, const Discretization& unburied) {
  std::vector<std::vector<CutTexel>> cut(scene.surfaces.size());
  if (std::any_of(scene.surfaces.begin(), scene.surfaces.end(), [](const Surface& s) { return s.twin.has_value(); }))
    return cut;
  const RayTree rays(scene);
  const std::vector<std::vector<Slice>> slices = triangleSlices(scene, rays);
  if (std::all_of(slices.begin(), slices.end(), [](const auto& some) { return some.empty(); })) return cut;
  const BuriedRegions regions(scene, unburied, slices, rays);
  raster::parallelFor(cut.size(), [&](std::size_t s) { cut[s] = regions.cutTexels(static_cast<std::uint32_t>(s)); });
  return cut;
}

}  // namespace hemitex::radiosity
