#include "radiosity/discretization/cut_surface.h"

#include <algorithm>
#include <array>
#include <boost/pending/disjoint_sets.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "radiosity/discretization/exposed_pieces.h"
#include "radiosity/discretization/neighbours.h"
#include "radiosity/discretization/texel_areas.h"
#include "radiosity/geometry/box_tree.h"
#include "raster/base/cross.h"

namespace hemitex::radiosity {
namespace {

/// Cosine of the largest angle between the normals of neighbours that belong to one region. Beyond 45 degrees one can
/// face the inside of a solid that the other stands on. (Tests of exposure hold with 0, too.)
constexpr double minCosine = 0.7;
/// Relative to the area of the triangle; smaller pieces are rounding noise: about 2^6 units of 2^-53.
constexpr double smallestShare = 1e-14;

using raster::cross;

PlaneBox boxAround(const glm::dvec2& a, const glm::dvec2& b, double margin) {
  return {glm::min(a, b) - margin, glm::max(a, b) + margin};
}

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

bool contains(const Piece& piece, const glm::dvec2& weights) {
  for (std::size_t i = 0; i < piece.size; ++i) {
    const glm::dvec2 corner = piece.corners[i].weight;
    if (cross(piece.corners[(i + 1) % piece.size].weight - corner, weights - corner) < 0) return false;
  }
  return true;
}

/// Whether a side of a piece lies on an edge of its triangle, by the opposite corner.
std::array<bool, 3> edgesOf(const Piece& piece) {
  constexpr double rounding = 1e-12;
  std::array<int, 3> corners{};
  for (std::size_t i = 0; i < piece.size; ++i) {
    const glm::dvec2& weight = piece.corners[i].weight;
    const std::array<double, 3> all{1 - weight.x - weight.y, weight.x, weight.y};
    for (std::size_t k = 0; k < 3; ++k) corners[k] += std::abs(all[k]) <= rounding ? 1 : 0;
  }
  return {corners[0] > 1, corners[1] > 1, corners[2] > 1};
}

/// A segment in space.
struct Segment {
  glm::dvec3 from, to;
};

/// The box around a segment, seen along an axis of space.
PlaneBox boxAlong(int axis, const Segment& segment, double margin) {
  const auto seen = [axis](const glm::dvec3& p) { return glm::dvec2(p[(axis + 1) % 3], p[(axis + 2) % 3]); };
  return boxAround(seen(segment.from), seen(segment.to), margin);
}

/// The part of a segment, as distances from its first end, that another one covers; without length if the other does
/// not lie along it within a tolerance.
glm::dvec2 overlap(const Segment& segment, const Segment& other, double tolerance) {
  const double length = glm::distance(segment.from, segment.to);
  const glm::dvec3 along = (segment.to - segment.from) / length;
  const auto isOff = [&](const glm::dvec3& point) {
    return glm::length(glm::cross(along, point - segment.from)) > tolerance;
  };
  if (isOff(other.from) || isOff(other.to)) return glm::dvec2(0);
  const double first = glm::dot(along, other.from - segment.from), last = glm::dot(along, other.to - segment.from);
  return {std::max(std::min(first, last), 0.0), std::min(std::max(first, last), length)};
}

/// Whether two sides of pieces have a common part longer than the tolerance that no wall covers.
bool haveOpenBorder(const Segment& side, const Segment& other, std::span<const Segment> walls, double tolerance) {
  const glm::dvec2 common = overlap(side, other, tolerance);
  double open = common.x;  // where the part begins that no wall visited so far covers
  if (common.y - open <= 2 * tolerance) return false;
  std::vector<std::pair<double, double>> covered;
  for (const Segment& wall : walls)
    if (const glm::dvec2 part = overlap(side, wall, tolerance); part.y > part.x) covered.emplace_back(part.x, part.y);
  covered.emplace_back(common.y, common.y);
  std::sort(covered.begin(), covered.end());
  for (const auto& [first, last] : covered) {
    if (std::min(first, common.y) - open > 2 * tolerance) return true;
    open = std::max(open, last);
  }
  return false;
}

class SurfaceCutter {
 public:
  SurfaceCutter(const Surface& surface, const GridSize& grid, std::span<const std::vector<Slice>> slices,
                double tolerance, Regions regions)
      : surface_(surface), grid_(grid), slices_(slices), tolerance_(tolerance), regions_(regions) {
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      cut_.first.push_back(static_cast<std::uint32_t>(cut_.cuttings.size()));
      cut_.isCut.push_back(!slices_[t].empty() || (regions == Regions::Connected && grid_.columns * grid_.rows > 1));
      cut(t);
    }
    cut_.first.push_back(static_cast<std::uint32_t>(cut_.cuttings.size()));
    joined_ = boost::disjoint_sets_with_storage<>(cut_.cuttings.size());
    regions == Regions::Connected ? joinOpenBorders() : joinTexels();
    findRegions();
  }

  CutSurface take() { return std::move(cut_); }

 private:
  /// Fills the cuttings of each region, largest first.
  void findRegions() {
    std::map<std::size_t, std::size_t> numbers;  // in the order of their first cuttings
    for (std::uint32_t i = 0; i < cut_.cuttings.size(); ++i) {
      const std::size_t number = numbers.try_emplace(joined_.find_set(i), cut_.regions.size()).first->second;
      if (number == cut_.regions.size()) cut_.regions.emplace_back();
      cut_.regions[number].push_back(i);
    }
    for (std::vector<std::uint32_t>& region : cut_.regions)
      std::stable_sort(region.begin(), region.end(),
                       [&](std::uint32_t a, std::uint32_t b) { return cut_.cuttings[a].area > cut_.cuttings[b].area; });
  }

  void cut(std::uint32_t number) {
    const Triangle& triangle = surface_.triangles[number];
    const double wholeArea = area(triangle);
    const TrianglePlane plane(triangle);
    std::vector<Slice> slices;
    std::vector<PlaneBox> boxes;
    for (const Slice& slice : slices_[number]) {
      slices.push_back({plane.place(slice.from), plane.place(slice.to)});
      boxes.push_back(boxAround(slices.back().from, slices.back().to, 0));
    }
    const BoxTree tree(boxes);
    std::vector<std::uint32_t> near;
    forEachCell(
        inTexels(triangle, grid_.columns, grid_.rows), [&](std::int64_t column, std::int64_t row, const Piece& whole) {
          if (share(whole) <= smallestShare) return;
          const PlaneBox bounds = boxOf(whole, plane);
          if (!slices.empty()) tree.find(boxAround(bounds.low, bounds.high, 2 * tolerance_), near);
          const std::vector<Piece> pieces = piecesOf(whole, plane, slices, near);
          for (const Piece& piece : pieces) {
            cut_.cuttings.push_back({static_cast<std::uint32_t>(texelOfCell(column, row, grid_.columns, grid_.rows)),
                                     number, nullptr, centroid(piece), share(piece) * wholeArea});
            if (pieces.size() > 1 || regions_ == Regions::Connected)
              cut_.cuttings.back().piece = std::make_shared<const Piece>(piece);
            isNearSlice_.push_back(!near.empty());
            isAtEdge_.push_back(edgesOf(piece));
          }
        });
  }

  /// The pieces into which the slices with these numbers cut a piece.
  std::vector<Piece> piecesOf(const Piece& whole, const TrianglePlane& plane, const std::vector<Slice>& slices,
                              const std::vector<std::uint32_t>& near) const {
    PieceList pieces(whole, plane);
    for (const std::uint32_t slice : near)
      for (const std::uint32_t i : pieces.near(boxAround(slices[slice].from, slices[slice].to, 0))) {
        std::vector<Piece> parts = splitBy(pieces.at(i), plane, slices[slice], tolerance_);
        std::erase_if(parts, [](const Piece& part) { return share(part) <= smallestShare; });
        if (!parts.empty()) pieces.replace(i, parts);
      }
    return pieces.take();
  }

  bool areJoined(std::uint32_t a, std::uint32_t b) { return joined_.find_set(a) == joined_.find_set(b); }

  /// Joins the cuttings in the same texel and in adjacent texels that are on the same or on neighbouring triangles, far
  /// from all slices.
  void joinTexels() {
    std::vector<std::vector<std::uint32_t>> inTexel(static_cast<std::size_t>(grid_.columns) *
                                                    static_cast<std::size_t>(grid_.rows));
    for (std::uint32_t i = 0; i < cut_.cuttings.size(); ++i)
      if (!isNearSlice_[i]) inTexel[cut_.cuttings[i].texel].push_back(i);
    const auto across = neighbours(surface_);
    const auto isAt = [&](std::uint32_t cutting, std::uint32_t neighbour) {
      const auto& beside = across[cut_.cuttings[cutting].triangle];
      for (std::size_t k = 0; k < 3; ++k)
        if (beside[k] == neighbour && isAtEdge_[cutting][k]) return true;
      return false;
    };
    const auto areBeside = [&](std::uint32_t a, std::uint32_t b) {
      const std::uint32_t t = cut_.cuttings[a].triangle, other = cut_.cuttings[b].triangle;
      return t == other || (isAt(a, other) && isAt(b, t) &&
                            glm::dot(normal(surface_.triangles[t]), normal(surface_.triangles[other])) >= minCosine);
    };
    const auto columns = static_cast<std::size_t>(grid_.columns);
    for (std::size_t texel = 0; texel < inTexel.size(); ++texel)
      for (const std::size_t other : {texel, texel + 1, texel + columns}) {
        if (other >= inTexel.size() || (other == texel + 1 && other % columns == 0)) continue;
        for (const std::uint32_t a : inTexel[texel])
          for (const std::uint32_t b : inTexel[other])
            if (!areJoined(a, b) && areBeside(a, b)) joined_.union_set(a, b);
      }
  }

  void joinOpenBorders() {
    const auto across = neighbours(surface_);
    for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
      if (cut_.isCut[t]) joinOpenBorders(t, t);
      for (const std::uint32_t other : across[t]) {
        if (other == noNeighbour || other < t) continue;
        if (cut_.isCut[t] || cut_.isCut[other])
          joinOpenBorders(t, other);
        else
          joined_.union_set(cut_.first[t], cut_.first[other]);
      }
    }
  }

  void joinOpenBorders(std::uint32_t triangle, std::uint32_t other) {
    const glm::dvec3 n = glm::abs(normal(surface_.triangles[triangle]));
    const int axis = n.x >= n.y && n.x >= n.z ? 0 : n.y >= n.z ? 1 : 2;
    std::vector<Segment> walls;
    std::vector<PlaneBox> wallBoxes, sideBoxes;
    for (const std::uint32_t t : {triangle, other})
      for (const Slice& slice : slices_[t]) {
        walls.push_back({placeOn(t, slice.from), placeOn(t, slice.to)});
        wallBoxes.push_back(boxAlong(axis, walls.back(), 0));
      }
    const std::vector<std::pair<std::uint32_t, Segment>> sides = sidesOf(triangle), otherSides = sidesOf(other);
    for (const auto& [b, side] : otherSides) sideBoxes.push_back(boxAlong(axis, side, 0));
    const BoxTree wallTree(wallBoxes), sideTree(sideBoxes);
    std::vector<std::uint32_t> nearSides, nearWalls;
    for (const auto& [a, side] : sides) {
      const PlaneBox box = boxAlong(axis, side, 2 * tolerance_);
      sideTree.find(box, nearSides);
      wallTree.find(box, nearWalls);
      std::vector<Segment> beside;
      for (const std::uint32_t wall : nearWalls) beside.push_back(walls[wall]);
      for (const std::uint32_t near : nearSides) {
        const auto& [b, otherSide] = otherSides[near];
        if (!areJoined(a, b) && haveOpenBorder(side, otherSide, beside, 2 * tolerance_)) joined_.union_set(a, b);
      }
    }
  }

  /// The sides of the cuttings of a triangle, longer than the tolerance, with the numbers of the cuttings.
  std::vector<std::pair<std::uint32_t, Segment>> sidesOf(std::uint32_t triangle) const {
    std::vector<std::pair<std::uint32_t, Segment>> sides;
    const Piece whole = wholeTriangle(surface_.triangles[triangle].chart);
    for (std::uint32_t c = cut_.first[triangle]; c < cut_.first[triangle + 1]; ++c) {
      const Piece& piece = cut_.cuttings[c].piece ? *cut_.cuttings[c].piece : whole;
      for (std::size_t i = 0; i < piece.size; ++i) {
        const Segment side{placeOn(triangle, piece.corners[i].weight),
                           placeOn(triangle, piece.corners[(i + 1) % piece.size].weight)};
        if (glm::distance(side.from, side.to) > tolerance_) sides.emplace_back(c, side);
      }
    }
    return sides;
  }

  glm::dvec3 placeOn(std::uint32_t triangle, const glm::dvec2& weights) const {
    const auto& [a, b, c] = surface_.triangles[triangle].position;
    return a + weights.x * (b - a) + weights.y * (c - a);
  }

  const Surface& surface_;
  const GridSize& grid_;
  std::span<const std::vector<Slice>> slices_;  ///< one entry per triangle
  double tolerance_;
  Regions regions_;
  CutSurface cut_;
  std::vector<std::array<bool, 3>> isAtEdge_;   ///< of each cutting, by the opposite corner of the triangle
  std::vector<bool> isNearSlice_;               ///< of each cutting: whether a slice meets its bounds
  boost::disjoint_sets_with_storage<> joined_;  ///< cuttings of a region
};

}  // namespace

CutSurface cutSurface(const Surface& surface, const GridSize& grid, std::span<const std::vector<Slice>> slices,
                      double tolerance, Regions regions) {
  return SurfaceCutter(surface, grid, slices, tolerance, regions).take();
}

std::uint32_t cuttingAt(const CutSurface& cut, const Surface& surface, const GridSize& grid, std::uint32_t triangle,
                        const glm::dvec2& weights) {
  const std::uint32_t first = cut.first[triangle], end = cut.first[triangle + 1];
  if (!cut.isCut[triangle]) return first;
  const auto [a, b, c] = inTexels(surface.triangles[triangle], grid.columns, grid.rows);
  const glm::dvec2 place = a + weights.x * (b - a) + weights.y * (c - a);
  const std::size_t texel = texelOfCell(static_cast<std::int64_t>(std::floor(place.x)),
                                        static_cast<std::int64_t>(std::floor(place.y)), grid.columns, grid.rows);
  // The cuttings of a triangle are in the order of texels.
  const auto before = [](const Cutting& cutting, std::size_t number) { return cutting.texel < number; };
  const auto begin = cut.cuttings.begin();
  auto at = std::lower_bound(begin + first, begin + end, texel, before);
  for (; at != begin + end && at->texel == texel; ++at)
    if (!at->piece || contains(*at->piece, weights)) return static_cast<std::uint32_t>(at - begin);
  return first;
}

}  // namespace hemitex::radiosity
