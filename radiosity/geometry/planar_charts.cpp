#include "radiosity/geometry/planar_charts.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace hemitex::radiosity {
namespace {

constexpr double angleTolerance = 1e-4;
/// Relative difference up to which squared lengths of edges are equal; a scene far from zero has such rounding errors.
constexpr double lengthTolerance = 1e-6;
constexpr std::uint32_t none = UINT32_MAX;

using Indices = std::vector<std::uint32_t>;

/// Half-edge 3t + k runs from corner k of triangle t to the next corner.
std::uint32_t nextCorner(std::uint32_t halfEdge) { return halfEdge % 3 == 2 ? halfEdge - 2 : halfEdge + 1; }

/// Indices with keys.
template <typename Key>
using Keyed = std::vector<std::pair<Key, std::uint32_t>>;

/// Sorts by key, then by index, and gives equal keys the same number and different keys different numbers.
template <typename Key>
Indices sortAndNumber(Keyed<Key>& things) {
  std::sort(things.begin(), things.end());
  Indices numbers(things.size());
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < things.size(); ++i) {
    if (i > 0 && things[i - 1].first != things[i].first) ++number;
    numbers[things[i].second] = number;
  }
  return numbers;
}

/// A number for each corner, the same for equal positions.
Indices weld(std::span<const TrianglePositions> triangles) {
  Keyed<std::array<double, 3>> corners;
  for (const TrianglePositions& triangle : triangles) {
    for (const glm::dvec3& p : triangle) {
      corners.push_back({{p.x, p.y, p.z}, static_cast<std::uint32_t>(corners.size())});
    }
  }
  return sortAndNumber(corners);
}

/// The half-edges of each edge, of both directions.
struct Edges {
  Indices edge;       ///< of each half-edge
  Indices first;      ///< of each edge, in halfEdges; one more at the end
  Indices halfEdges;  ///< edge by edge, ascending

  std::span<const std::uint32_t> around(std::uint32_t e) const {
    return std::span(halfEdges).subspan(first[e], first[e + 1] - first[e]);
  }
};

Edges findEdges(std::span<const TrianglePositions> triangles) {
  const Indices vertex = weld(triangles);
  Keyed<std::pair<std::uint32_t, std::uint32_t>> halfEdges;
  for (std::uint32_t h = 0; h < vertex.size(); ++h) {
    halfEdges.push_back({std::minmax(vertex[h], vertex[nextCorner(h)]), h});
  }
  Edges edges;
  edges.edge = sortAndNumber(halfEdges);
  for (std::uint32_t i = 0; i < halfEdges.size(); ++i) {
    edges.halfEdges.push_back(halfEdges[i].second);
    if (edges.edge[halfEdges[i].second] == edges.first.size()) edges.first.push_back(i);
  }
  edges.first.push_back(static_cast<std::uint32_t>(halfEdges.size()));
  return edges;
}

glm::dvec3 unitNormal(const TrianglePositions& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  return normal / glm::length(normal);
}

class Splitter {
 public:
  explicit Splitter(std::span<const TrianglePositions> triangles)
      : triangles_(triangles),
        edges_(findEdges(triangles)),
        part_(triangles.size(), none),
        crossedBy_(edges_.first.size() - 1, none),
        uses_(edges_.first.size() - 1, 0) {
    for (const TrianglePositions& t : triangles) normals_.push_back(unitNormal(t));
  }

  std::vector<PlanarPart> split() {
    std::vector<PlanarPart> parts;
    std::uint32_t seed = 0;
    while (seed < triangles_.size()) {
      if (part_[seed] == none) {
        parts.push_back(cutPart(seed, static_cast<std::uint32_t>(parts.size())));
      } else {
        ++seed;
      }
    }
    std::sort(parts.begin(), parts.end(),
              [](const PlanarPart& a, const PlanarPart& b) { return a.triangles[0] < b.triangles[0]; });
    return parts;
  }

 private:
  /// Makes a part of free triangles around `seed`. Triangles that conflict in its chart stay free, perhaps `seed` too.
  PlanarPart cutPart(std::uint32_t seed, std::uint32_t number) {
    PlanarPart part{grow(seed, number), {}};
    while (!part.triangles.empty()) {
      part.charts = boundingRectangle(part.triangles);
      const std::vector<ChartConflict> conflicts = chartConflicts(part.charts);
      if (conflicts.empty()) return part;
      part.triangles = freed(part.triangles, conflicts);
    }
    return alone(seed, number);
  }

  /// Frees the triangles in conflict; returns the others.
  Indices freed(const Indices& triangles, const std::vector<ChartConflict>& conflicts) {
    for (const ChartConflict& conflict : conflicts) part_[triangles[conflict.triangle]] = none;
    Indices kept;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(kept),
                 [&](std::uint32_t t) { return part_[t] != none; });
    return kept;
  }

  /// The connected free triangles in the plane of `seed`, ascending.
  Indices grow(std::uint32_t seed, std::uint32_t number) {
    Indices found{seed};
    part_[seed] = number;
    for (std::size_t next = 0; next < found.size(); ++next) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const std::uint32_t edge = edges_.edge[3 * found[next] + k];
        if (std::exchange(crossedBy_[edge], number) == number) continue;
        for (const std::uint32_t h : edges_.around(edge)) {
          if (part_[h / 3] != none || !isParallel(seed, h / 3)) continue;
          part_[h / 3] = number;
          found.push_back(h / 3);
        }
      }
    }
    std::sort(found.begin(), found.end());
    return found;
  }

  bool isParallel(std::uint32_t a, std::uint32_t b) const {
    return glm::length(glm::cross(normals_[a], normals_[b])) <= angleTolerance &&
           glm::dot(normals_[a], normals_[b]) > 0;
  }

  /// A part of one triangle so thin that rounding collapses its rectangle: any chart with area will do.
  PlanarPart alone(std::uint32_t triangle, std::uint32_t number) {
    part_[triangle] = number;
    return {{triangle}, {ChartTriangle{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}}};
  }

  std::vector<ChartTriangle> boundingRectangle(const Indices& part) {
    const glm::dvec3 origin = triangles_[part[0]][0];
    const glm::dvec3 normal = normals_[part[0]];
    const glm::dvec3 edge = longestEdge(part);
    const glm::dvec3 inPlane = edge - glm::dot(edge, normal) * normal;
    const glm::dvec3 u = inPlane / glm::length(inPlane);
    const glm::dvec3 v = glm::cross(normal, u);
    std::vector<ChartTriangle> charts;
    glm::dvec2 low(0.0), high(0.0);
    for (const std::uint32_t t : part) {
      ChartTriangle& chart = charts.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 p = triangles_[t][k] - origin;
        chart[k] = {glm::dot(u, p), glm::dot(v, p)};
        low = glm::min(low, chart[k]);
        high = glm::max(high, chart[k]);
      }
    }
    for (ChartTriangle& chart : charts) {
      for (glm::dvec2& p : chart) p = (p - low) / (high - low);
      chart = roundedChart(chart);
    }
    return charts;
  }

  /// The first of the longest boundary edges of a part; any edge if overlapping triangles leave no boundary edge.
  glm::dvec3 longestEdge(const Indices& part) {
    countUses(part, 1);
    glm::dvec3 longest(0.0);
    for (const std::uint32_t t : part) {
      for (std::uint32_t k = 0; k < 3; ++k) {
        const glm::dvec3 edge = triangles_[t][(k + 1) % 3] - triangles_[t][k];
        const bool isBoundary = uses_[edges_.edge[3 * t + k]] == 1;
        if (isBoundary && glm::dot(edge, edge) > (1 + lengthTolerance) * glm::dot(longest, longest)) longest = edge;
      }
    }
    countUses(part, -1);
    return longest == glm::dvec3(0.0) ? triangles_[part[0]][1] - triangles_[part[0]][0] : longest;
  }

  void countUses(const Indices& part, int change) {
    for (const std::uint32_t t : part) {
      for (std::uint32_t k = 0; k < 3; ++k) uses_[edges_.edge[3 * t + k]] += change;
    }
  }

  std::span<const TrianglePositions> triangles_;
  Edges edges_;
  std::vector<glm::dvec3> normals_;
  Indices part_;           ///< number of each triangle's part; `none` if free
  Indices crossedBy_;      ///< for each edge the last part that grew over it
  std::vector<int> uses_;  ///< for each edge the number of triangles of the current part that have it
};

}  // namespace

std::vector<PlanarPart> planarParts(std::span<const TrianglePositions> triangles) {
  return Splitter(triangles).split();
}

}  // namespace hemitex::radiosity
