#include "radiosity/discretization/cut_surface.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/neighbours.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/box_tree.h"

namespace hemitex::radiosity {
namespace {

/// Cosine of the largest angle between the normals of neighbours that belong to one region.
constexpr double minCosine = 0.7;
/// Relative to the area of the triangle; smaller pieces are rounding noise.
constexpr double smallestShare = 1e-14;

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// A range along a line.
struct Range {
  double low = 0, high = 0;
};

/// The length of the part of a range that other ranges do not cover.
double uncovered(const Range& range, std::vector<Range>& covers) {
  std::sort(covers.begin(), covers.end(), [](const Range& a, const Range& b) { return a.low < b.low; });
  double left = 0, end = range.low;
  for (const Range& cover : covers) {
    left += std::max(0.0, std::min(cover.low, range.high) - end);
    end = std::max(end, std::min(cover.high, range.high));
  }
  return left + range.high - end;
}

/// The part of a range along a line that a segment on this line covers. The ends of the segment are given as place
/// along the line and distance from it.
std::optional<Range> coverOf(const Range& range, glm::dvec2 from, glm::dvec2 to, double distance) {
  if (from.x > to.x) std::swap(from, to);
  const double low = std::max(range.low, from.x), high = std::min(range.high, to.x);
  if (low >= high) return std::nullopt;
  const double slope = (to.y - from.y) / (to.x - from.x);
  const auto isNear = [&](double place) { return std::abs(from.y + slope * (place - from.x)) <= distance; };
  if (!isNear(low) || !isNear(high)) return std::nullopt;
  return Range{low, high};
}

PlaneBox boxAround(const glm::dvec2& a, const glm::dvec2& b, double margin) {
  return {glm::min(a, b) - margin, glm::max(a, b) + margin};
}

/// Segments in the plane of a triangle, in a tree for box queries.
class SegmentTree {
 public:
  /// Queries find segments within `margin` of a box.
  SegmentTree(const std::vector<Slice>& segments, double margin) : margin_(margin), tree_(boxesOf(segments)) {}

  /// The numbers of the segments near the box around two points, ascending.
  const std::vector<std::uint32_t>& near(const glm::dvec2& low, const glm::dvec2& high) {
    tree_.find(boxAround(low, high, margin_), found_);
    return found_;
  }

 private:
  static std::vector<PlaneBox> boxesOf(const std::vector<Slice>& segments) {
    std::vector<PlaneBox> boxes;
    boxes.reserve(segments.size());
    for (const Slice& segment : segments) boxes.push_back(boxAround(segment.from, segment.to, 0));
    return boxes;
  }

  double margin_;
  BoxTree tree_;
  std::vector<std::uint32_t> found_;
};

/// The plane of a triangle, in units of length.
struct TrianglePlane {
  glm::dmat2 axes;  ///< maps weights to positions

  explicit TrianglePlane(const Triangle& triangle) {
    const glm::dvec3 along1 = triangle.position[1] - triangle.position[0],
                     along2 = triangle.position[2] - triangle.position[0];
    const double length = glm::length(along1);
    axes = {{length, 0}, {glm::dot(along1, along2) / length, glm::length(glm::cross(along1, along2)) / length}};
  }

  glm::dvec2 place(const glm::dvec2& weights) const { return axes * weights; }
};

/// Splits a piece if a slice goes through it, else returns the piece. The slice is given in the plane.
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
  // The chord of the line through the piece, and the part of it that the slice covers.
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

/// The bounds of a piece in the plane.
PlaneBox boxOf(const Piece& piece, const TrianglePlane& plane) {
  PlaneBox box{plane.place(piece.corners[0].weight), plane.place(piece.corners[0].weight)};
  for (std::size_t i = 1; i < piece.size; ++i) {
    const glm::dvec2 corner = plane.place(piece.corners[i].weight);
    box = {glm::min(box.low, corner), glm::max(box.high, corner)};
  }
  return box;
}

/// The pieces of a texel while slices cut them. Many pieces are searched with a tree.
class PieceList {
 public:
  PieceList(const Piece& whole, const TrianglePlane& plane) : plane_(plane), pieces_{whole} {
    boxes_.push_back(boxOf(whole, plane));
  }

  const PlaneBox& bounds() const { return boxes_.front(); }  // of the whole, before the first cut
  const Piece& at(std::uint32_t number) const { return pieces_[number]; }

  /// The numbers of the pieces whose boxes meet a box, ascending.
  const std::vector<std::uint32_t>& near(const PlaneBox& box) {
    found_.clear();
    if (tree_)
      tree_->find(box, found_);
    else
      for (std::uint32_t i = 0; i < boxes_.size(); ++i)
        if (meet(boxes_[i], box)) found_.push_back(i);
    return found_;
  }

  /// Replaces a piece by parts: one takes its number, and the others go to the end.
  void replace(std::uint32_t number, const std::vector<Piece>& parts) {
    if (tree_) tree_->remove(boxes_[number], number);
    pieces_[number] = parts.front();
    boxes_[number] = boxOf(parts.front(), plane_);
    if (tree_) tree_->add(boxes_[number], number);
    for (auto part = parts.begin() + 1; part != parts.end(); ++part) {
      pieces_.push_back(*part);
      boxes_.push_back(boxOf(*part, plane_));
      if (tree_) tree_->add(boxes_.back(), static_cast<std::uint32_t>(boxes_.size() - 1));
    }
    if (!tree_ && boxes_.size() > maxListed) tree_.emplace(boxes_);
  }

  std::vector<Piece> take() { return std::move(pieces_); }

 private:
  static constexpr std::size_t maxListed = 32;

  const TrianglePlane& plane_;
  std::vector<Piece> pieces_;
  std::vector<PlaneBox> boxes_;  ///< of the pieces
  std::optional<BoxTree> tree_;  ///< of the boxes, if they are many
  std::vector<std::uint32_t> found_;
};

/// Whether two segments share a part of a line that no slice covers.
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

/// The part of a triangle's edge that belongs to a cutting, in lengths from the first corner of the edge.
struct EdgePart {
  Range range;
  std::uint32_t cutting = 0;
};

class SurfaceCutter {
 public:
  SurfaceCutter(const Surface& surface, const GridSize& grid, std::span<const std::vector<Slice>> slices,
                double tolerance)
      : surface_(surface), grid_(grid), slices_(slices), tolerance_(tolerance) {
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      first_.push_back(static_cast<std::uint32_t>(cuttings_.size()));
      if (slices[t].empty())
        cutWhole(t);
      else
        cut(t);
    }
    first_.push_back(static_cast<std::uint32_t>(cuttings_.size()));
    joinTriangles();
    findRegions();
  }

  CutSurface take() {
    CutSurface cut{std::move(cuttings_), std::move(first_), {}, std::move(regions_)};
    for (const std::vector<Slice>& slices : slices_) cut.isCut.push_back(!slices.empty());
    return cut;
  }

 private:
  /// Fills the cuttings of each region, largest first.
  void findRegions() {
    std::map<std::uint32_t, std::vector<std::uint32_t>> byRoot;
    for (std::uint32_t i = 0; i < cuttings_.size(); ++i) byRoot[rootOf(i)].push_back(i);
    for (auto& [root, region] : byRoot) {
      std::stable_sort(region.begin(), region.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return cuttings_[a].area > cuttings_[b].area; });
      regions_.push_back(std::move(region));
    }
  }

  using Edges = std::array<std::vector<EdgePart>, 3>;  ///< by the opposite corner

  std::uint32_t texelAt(std::int64_t column, std::int64_t row) const {
    return static_cast<std::uint32_t>(texelOfCell(column, row, grid_.columns, grid_.rows));
  }

  void add(std::uint32_t texel, std::uint32_t triangle, const Piece& piece, double wholeArea) {
    parent_.push_back(static_cast<std::uint32_t>(cuttings_.size()));
    cuttings_.push_back({texel, triangle, nullptr, centroid(piece), share(piece) * wholeArea});
  }

  /// A triangle without slices belongs to one region.
  void cutWhole(std::uint32_t triangle) {
    const double wholeArea = area(surface_.triangles[triangle]);
    forEachCell(inTexels(surface_.triangles[triangle], grid_.columns, grid_.rows),
                [&](std::int64_t column, std::int64_t row, const Piece& whole) {
                  if (share(whole) <= smallestShare) return;
                  add(texelAt(column, row), triangle, whole, wholeArea);
                  parent_.back() = first_[triangle];
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

  /// The pieces into which slices cut a piece.
  std::vector<Piece> piecesOf(const Piece& whole, const TrianglePlane& plane, const std::vector<Slice>& slices,
                              SegmentTree& tree) const {
    PieceList pieces(whole, plane);
    for (const std::uint32_t slice : tree.near(pieces.bounds().low, pieces.bounds().high))
      for (const std::uint32_t i : pieces.near(boxAround(slices[slice].from, slices[slice].to, 0))) {
        std::vector<Piece> parts = splitBy(pieces.at(i), plane, slices[slice], tolerance_);
        std::erase_if(parts, [](const Piece& part) { return share(part) <= smallestShare; });
        if (!parts.empty()) pieces.replace(i, parts);
      }
    return pieces.take();
  }

  std::uint32_t rootOf(std::uint32_t cutting) {
    while (parent_[cutting] != cutting) {
      parent_[cutting] = parent_[parent_[cutting]];
      cutting = parent_[cutting];
    }
    return cutting;
  }

  void join(std::uint32_t a, std::uint32_t b) {
    const std::uint32_t rootA = rootOf(a), rootB = rootOf(b);
    parent_[std::max(rootA, rootB)] = std::min(rootA, rootB);
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

  /// Lengths that barycentric weights of a point correspond to: along an edge, and above it.
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

  /// The slices that come near an edge, as places along it and heights above it. `isReversed` means that places
  /// count from the other end of the edge.
  void addNear(std::uint32_t triangle, const EdgeFrame& frame, bool isReversed, std::vector<Slice>& near) const {
    for (const Slice& slice : slices_[triangle]) {
      glm::dvec2 from = frame.place(slice.from), to = frame.place(slice.to);
      if (std::min(from.y, to.y) > 4 * tolerance_ || std::max(from.y, to.y) < -4 * tolerance_) continue;
      if (isReversed) {
        from.x = frame.length - from.x;
        to.x = frame.length - to.x;
      }
      near.push_back({from, to});
    }
  }

  /// Joins cuttings across common edges of triangles, except where the surface folds sharply.
  void joinTriangles() {
    const auto across = neighbours(surface_);
    std::vector<glm::dvec3> normals;
    for (const Triangle& triangle : surface_.triangles) normals.push_back(normal(triangle));
    for (std::uint32_t t = 0; t < across.size(); ++t)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t other = across[t][k];
        if (other == noNeighbour || hasNone(t) || hasNone(other)) continue;
        if (glm::dot(normals[t], normals[other]) < minCosine) continue;
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
    std::vector<Slice> slices;
    addNear(triangle, frame, false, slices);
    addNear(other, otherFrame, isReversed, slices);
    for (EdgePart& part : edgeParts(other, otherFrame)) {
      if (isReversed) part.range = {frame.length - part.range.high, frame.length - part.range.low};
      for (const EdgePart& own : edgeParts(triangle, frame)) {
        const Range range{std::max(own.range.low, part.range.low), std::min(own.range.high, part.range.high)};
        if (range.high - range.low <= 4 * tolerance_ || rootOf(own.cutting) == rootOf(part.cutting)) continue;
        std::vector<Range> covers;
        for (const Slice& slice : slices)
          if (const auto cover = coverOf(range, slice.from, slice.to, 2 * tolerance_)) covers.push_back(*cover);
        if (uncovered(range, covers) > 4 * tolerance_) join(own.cutting, part.cutting);
      }
    }
  }

  const Surface& surface_;
  const GridSize& grid_;
  std::span<const std::vector<Slice>> slices_;  ///< one entry per triangle
  double tolerance_;
  std::vector<Cutting> cuttings_;      ///< by triangle
  std::vector<std::uint32_t> parent_;  ///< of each cutting, in the union-find forest of all cuttings
  std::vector<std::vector<std::uint32_t>> regions_;
  std::vector<std::uint32_t> first_;      ///< first cutting of each triangle; one more at the end
  std::map<std::uint32_t, Edges> edges_;  ///< of the triangles with slices
};

}  // namespace

CutSurface cutSurface(const Surface& surface, const GridSize& grid, std::span<const std::vector<Slice>> slices,
                      double tolerance) {
  return SurfaceCutter(surface, grid, slices, tolerance).take();
}

std::uint32_t cuttingAt(const CutSurface& cut, const Surface& surface, const GridSize& grid, std::uint32_t triangle,
                        const glm::dvec2& weights) {
  const std::uint32_t first = cut.first[triangle], end = cut.first[triangle + 1];
  if (!cut.isCut[triangle]) return first;
  const auto [a, b, c] = inTexels(surface.triangles[triangle], grid.columns, grid.rows);
  const glm::dvec2 place = a + weights.x * (b - a) + weights.y * (c - a);
  const std::size_t texel = texelOfCell(static_cast<std::int64_t>(std::floor(place.x)),
                                        static_cast<std::int64_t>(std::floor(place.y)), grid.columns, grid.rows);
  for (std::uint32_t i = first; i < end; ++i)
    if (cut.cuttings[i].texel == texel && (!cut.cuttings[i].piece || contains(*cut.cuttings[i].piece, weights)))
      return i;
  return first;
}

}  // namespace hemitex::radiosity
