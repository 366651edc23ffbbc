#include "reference/truth/closed_forms/merged_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "radiosity/geometry/triangulation.h"

namespace hemitex::reference {
namespace {

constexpr double planeTolerance = 1e-12;  // in extents of the scene
constexpr double areaTolerance = 1e-11;   // relative

using Outline = std::vector<glm::dvec3>;

double areaOf(const Outline& corner, const glm::dvec3& normal) {
  return glm::dot(radiosity::newellNormal(corner), normal) / 2;
}

/// Corners that are equal up to rounding nearly always have one key. Where they have two, the outline is not closed and
/// pieces are not merged.
using Key = std::array<std::int64_t, 3>;
Key keyOf(const glm::dvec3& corner) {
  Key key{};
  for (int axis = 0; axis < 3; ++axis) key[static_cast<std::size_t>(axis)] = std::llround(corner[axis] * 0x1p40);
  return key;
}

bool areCoplanar(std::span<const SurfacePiece> pieces) {
  const glm::dvec3 &normal = pieces.front().normal, &origin = pieces.front().corner.front();
  return std::all_of(pieces.begin(), pieces.end(), [&](const SurfacePiece& piece) {
    return glm::dot(piece.normal, normal) > 0 &&
           std::all_of(piece.corner.begin(), piece.corner.end(), [&](const glm::dvec3& corner) {
             return std::fabs(glm::dot(corner - origin, normal)) <= planeTolerance;
           });
  });
}

/// The edges of pieces that no other piece has in reverse, each as the corner that follows another. Nothing if two
/// start at one corner.
std::optional<std::map<Key, glm::dvec3>> boundaryOf(std::span<const SurfacePiece> pieces) {
  std::map<std::pair<Key, Key>, glm::dvec3> edges;  // with the second corner
  for (const SurfacePiece& piece : pieces)
    for (std::size_t i = 0; i < piece.corner.size(); ++i) {
      const glm::dvec3& to = piece.corner[(i + 1) % piece.corner.size()];
      const Key a = keyOf(piece.corner[i]), b = keyOf(to);
      if (a != b && edges.erase({b, a}) == 0) edges.emplace(std::pair(a, b), to);
    }
  std::map<Key, glm::dvec3> next;
  for (const auto& [edge, to] : edges)
    if (!next.emplace(edge.first, to).second) return std::nullopt;
  return next;
}

/// The outline of a boundary that is one loop, else nothing.
std::optional<Outline> loopOf(const std::map<Key, glm::dvec3>& next) {
  Outline loop;
  if (next.empty()) return std::nullopt;
  Key at = next.begin()->first;
  do {
    const auto edge = next.find(at);
    if (edge == next.end() || loop.size() == next.size()) return std::nullopt;
    loop.push_back(edge->second);
    at = keyOf(edge->second);
  } while (at != next.begin()->first);
  return loop.size() == next.size() ? std::optional(loop) : std::nullopt;
}

/// The corners at which an outline turns; nothing if it turns to the right somewhere.
std::optional<Outline> convexCorners(const Outline& loop, const glm::dvec3& normal) {
  Outline corners;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec3 before = corners.empty() ? loop.back() : corners.back();
    const glm::dvec3 in = loop[i] - before, out = loop[(i + 1) % loop.size()] - loop[i];
    const double turn = glm::dot(glm::cross(in, out), normal);
    if (std::fabs(turn) <= planeTolerance * glm::length(in) * glm::length(out) && glm::dot(in, out) > 0) continue;
    if (turn <= 0) return std::nullopt;
    corners.push_back(loop[i]);
  }
  return corners.size() >= 3 ? std::optional(corners) : std::nullopt;
}

std::optional<Outline> convexOutline(std::span<const SurfacePiece> pieces) {
  if (pieces.size() < 2 || !areCoplanar(pieces)) return std::nullopt;
  const auto boundary = boundaryOf(pieces);
  const auto loop = boundary ? loopOf(*boundary) : std::nullopt;
  const auto corners = loop ? convexCorners(*loop, pieces.front().normal) : std::nullopt;
  if (!corners) return std::nullopt;
  double sum = 0;
  for (const SurfacePiece& piece : pieces) sum += areaOf(piece.corner, piece.normal);
  return std::fabs(areaOf(*corners, pieces.front().normal) - sum) <= areaTolerance * sum ? corners : std::nullopt;
}

}  // namespace

ConvexPolygons convexPolygons(const radiosity::Scene& scene, const radiosity::Surface& surface) {
  constexpr std::size_t mostCorners = 7;
  std::vector<SurfacePiece> pieces;
  ConvexPolygons triangles;
  for (const radiosity::Triangle& triangle : surface.triangles) {
    if (radiosity::area(triangle) == 0) continue;
    const auto corners = inFrame(scene, triangle);
    triangles.emplace_back(corners.begin(), corners.end());
    pieces.push_back({0, 0, radiosity::normal(triangle), triangles.back(), {}});
  }
  const std::optional<Outline> outline = convexOutline(pieces);
  return outline && outline->size() <= mostCorners ? ConvexPolygons{*outline} : triangles;
}

std::vector<ConvexPolygons> convexPolygons(const radiosity::Scene& scene) {
  std::vector<ConvexPolygons> result;
  for (const radiosity::Surface& surface : scene.surfaces) result.push_back(convexPolygons(scene, surface));
  return result;
}

ConvexPolygons placed(const radiosity::Scene& scene, const ConvexPolygons& polygons,
                      const radiosity::Instance& instance) {
  ConvexPolygons result = polygons;
  const glm::dvec3 shift = inFrame(scene, instance(scene.origin));
  for (std::vector<glm::dvec3>& polygon : result) {
    for (glm::dvec3& corner : polygon) corner = instance.sign * corner + shift;
    if (instance.reflects()) std::reverse(polygon.begin(), polygon.end());
  }
  return result;
}

SurfacePieces mergedPieces(const SurfacePieces& pieces) {
  SurfacePieces result;
  result.first.push_back(0);
  for (std::uint32_t element = 0; element + 1 < pieces.first.size(); ++element) {
    const std::span<const SurfacePiece> own = pieces.of(element);
    if (std::optional<Outline> outline = convexOutline(own)) {
      result.pieces.push_back(own.front());
      result.pieces.back().corner = *std::move(outline);
      result.pieces.back().onChart.clear();
    } else {
      result.pieces.insert(result.pieces.end(), own.begin(), own.end());
    }
    result.first.push_back(static_cast<std::uint32_t>(result.pieces.size()));
  }
  return result;
}

}  // namespace hemitex::reference
