#include "radiosity/geometry/mesh_charts.h"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace hemitex::radiosity {
namespace {

constexpr double angleTolerance = 1e-4;
/// Relative difference up to which squared lengths of edges are equal; a scene far from zero has such rounding errors.
constexpr double lengthTolerance = 1e-6;
/// The cosines of 58 and 60 degrees. Six parts of 54.7 degrees cover a ball; its facets need a margin. The difference
/// between both lets a part take in what juts out of its neighbours.
constexpr double nearCosine = 0.529919264233205, maxCosine = 0.5;
/// A region takes in triangles of regions that have less than this share of its area: small bumps, not its equals.
constexpr double smallShare = 0.125;
/// A mean normal shorter than this says little: the component is closed, or nearly so.
constexpr double shortMean = 0.1;

using Indices = std::vector<std::uint32_t>;

/// Parts made of triangles that no part has yet.
class Parts {
 public:
  Parts(std::span<const TrianglePositions> triangles, const MeshEdges& edges, std::span<const std::uint32_t> faces)
      : triangles_(triangles), edges_(edges), faces_(faces), sets_(edges), uses_(edges.count(), 0) {}

  /// Makes parts until `seed` has one. Each grows from `seed` over edges to free triangles that `accepts` allows, given
  /// the half-edges of both triangles. Triangles that conflict in its chart stay free, perhaps `seed` too.
  void add(std::uint32_t seed, const glm::dvec3& direction, const Connects& accepts,
           const std::optional<std::uint32_t>& component = {}) {
    while (sets_.isFree(seed)) {
      parts_.push_back(cutPart(seed, direction, accepts));
      parts_.back().component = component;
    }
  }

  std::vector<ChartedPart> ordered() && {
    std::sort(parts_.begin(), parts_.end(),
              [](const ChartedPart& a, const ChartedPart& b) { return a.triangles[0] < b.triangles[0]; });
    return std::move(parts_);
  }

 private:
  std::uint32_t number() const { return static_cast<std::uint32_t>(parts_.size()); }

  ChartedPart cutPart(std::uint32_t seed, const glm::dvec3& direction, const Connects& accepts) {
    ChartedPart part{sets_.grow(seed, number(), accepts), {}};
    while (!part.triangles.empty()) {
      part.charts = boundingRectangle(part.triangles, direction);
      const auto isOfFirstFace = [&](std::uint32_t t) { return faces_[t] == faces_[part.triangles[0]]; };
      const bool isOneFace = std::all_of(part.triangles.begin(), part.triangles.end(), isOfFirstFace);
      const std::vector<ChartConflict> conflicts = chartConflicts(part.charts, SIZE_MAX, !isOneFace);
      if (conflicts.empty()) return part;
      part.triangles = freed(part.triangles, conflicts);
    }
    return alone(seed);
  }

  /// Frees the triangles in conflict; returns the others.
  Indices freed(const Indices& triangles, const std::vector<ChartConflict>& conflicts) {
    for (const ChartConflict& conflict : conflicts) sets_.setOwner(triangles[conflict.triangle], SetGrower::none);
    Indices kept;
    std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(kept),
                 [&](std::uint32_t t) { return !sets_.isFree(t); });
    return kept;
  }

  /// A part of one triangle so thin that rounding collapses its rectangle: any chart with area will do.
  ChartedPart alone(std::uint32_t triangle) {
    sets_.setOwner(triangle, number());
    return {{triangle}, {ChartTriangle{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(0, 1)}}};
  }

  std::vector<ChartTriangle> boundingRectangle(const Indices& part, const glm::dvec3& direction) {
    const glm::dvec3 origin = triangles_[part[0]][0];
    const glm::dvec3 edge = longestEdge(part);
    const glm::dvec3 inPlane = edge - glm::dot(edge, direction) * direction;
    const glm::dvec3 u = inPlane / glm::length(inPlane);
    const glm::dvec3 v = glm::cross(direction, u);
    std::vector<ChartTriangle> charts;
    charts.reserve(part.size());
    for (const std::uint32_t t : part) {
      ChartTriangle& chart = charts.emplace_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 p = triangles_[t][k] - origin;
        chart[k] = {glm::dot(u, p), glm::dot(v, p)};
      }
    }
    return scaledToSquare(std::move(charts));
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
  const MeshEdges& edges_;
  std::span<const std::uint32_t> faces_;
  SetGrower sets_;         ///< the owner of a triangle is its part
  std::vector<int> uses_;  ///< for each edge the number of triangles of the current part that have it
  std::vector<ChartedPart> parts_;
};

std::vector<glm::dvec3> unitNormals(std::span<const TrianglePositions> triangles) {
  std::vector<glm::dvec3> normals;
  normals.reserve(triangles.size());
  for (const TrianglePositions& triangle : triangles) normals.push_back(unitNormal(triangle));
  return normals;
}

double areaOf(const TrianglePositions& t) { return glm::length(glm::cross(t[1] - t[0], t[2] - t[0])) / 2; }

class CurvedSplitter {
 public:
  CurvedSplitter(std::span<const TrianglePositions> triangles, const MeshEdges& edges,
                 std::span<const std::uint32_t> faces, const Connects& isSmooth)
      : triangles_(triangles), edges_(edges), faces_(faces), isSmooth_(isSmooth), normals_(unitNormals(triangles)) {}

  std::vector<ChartedPart> split() {
    components_ = connectedSets(edges_, isSmooth_);
    label_.resize(triangles_.size());
    for (const Indices& component : components_.triangles) chooseDirections(component);
    const TriangleSets regions = connectedSets(edges_, [&](std::uint32_t h, std::uint32_t other) {
      return label_[h / 3] == label_[other / 3] && isSmooth_(h, other);
    });
    return partsOf(regions);
  }

 private:
  /// Adds the directions of a component, and labels each of its triangles with the nearest one.
  void chooseDirections(const Indices& component) {
    const auto isPlanar = [&](std::uint32_t t) { return areParallel(normals_[component[0]], normals_[t]); };
    isCurved_.push_back(!std::all_of(component.begin(), component.end(), isPlanar));
    if (!isCurved_.back()) {
      for (const std::uint32_t t : component) label_[t] = static_cast<std::uint32_t>(directions_.size());
      directions_.push_back(normals_[component[0]]);
      return;
    }
    std::vector<double> cosines(component.size(), -2);
    glm::dvec3 direction = meanNormal(component);
    for (double farthest = -1; farthest < nearCosine;) {
      const auto number = static_cast<std::uint32_t>(directions_.size());
      directions_.push_back(direction);
      farthest = 2;
      for (std::size_t i = 0; i < component.size(); ++i) {
        const double cosine = glm::dot(normals_[component[i]], directions_[number]);
        if (cosine > cosines[i]) {
          cosines[i] = cosine;
          label_[component[i]] = number;
        }
        if (cosines[i] < farthest) {
          farthest = cosines[i];
          direction = normals_[component[i]];
        }
      }
    }
  }

  /// The mean by area, or the normal of the first triangle if the normals of a closed surface cancel.
  glm::dvec3 meanNormal(const Indices& component) const {
    glm::dvec3 sum(0);
    double area = 0;
    for (const std::uint32_t t : component) {
      sum += areaOf(triangles_[t]) * normals_[t];
      area += areaOf(triangles_[t]);
    }
    const double length = glm::length(sum);
    return length < shortMean * area ? normals_[component[0]] : sum / length;
  }

  /// Large regions first, so that they can take in triangles of small ones.
  std::vector<ChartedPart> partsOf(const TriangleSets& regions) const {
    std::vector<double> areas;
    for (const Indices& region : regions.triangles) {
      areas.push_back(0);
      for (const std::uint32_t t : region) areas.back() += areaOf(triangles_[t]);
    }
    Indices order(areas.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
    Parts parts(triangles_, edges_, faces_);
    for (const std::uint32_t region : order) {
      const std::uint32_t first = regions.triangles[region][0], component = components_.owner[first];
      const glm::dvec3 direction = directions_[label_[first]];
      const auto number = isCurved_[component] ? std::optional(component) : std::nullopt;
      const auto accepts = [&](std::uint32_t h, std::uint32_t other) {
        const std::uint32_t owner = regions.owner[other / 3];
        return isSmooth_(h, other) && (owner == region || (areas[owner] < smallShare * areas[region] &&
                                                           glm::dot(normals_[other / 3], direction) >= maxCosine));
      };
      for (const std::uint32_t seed : regions.triangles[region]) parts.add(seed, direction, accepts, number);
    }
    return std::move(parts).ordered();
  }

  std::span<const TrianglePositions> triangles_;
  const MeshEdges& edges_;
  std::span<const std::uint32_t> faces_;
  const Connects& isSmooth_;
  std::vector<glm::dvec3> normals_;
  std::vector<glm::dvec3> directions_;
  TriangleSets components_;     ///< the triangles that smooth edges connect
  std::vector<bool> isCurved_;  ///< for each component
  Indices label_;               ///< for each triangle its direction
};

}  // namespace

std::vector<ChartTriangle> scaledToSquare(std::vector<ChartTriangle> charts) {
  glm::dvec2 low = charts.front()[0], high = low;
  for (const ChartTriangle& chart : charts) {
    for (const glm::dvec2& p : chart) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  }
  for (ChartTriangle& chart : charts) {
    for (glm::dvec2& p : chart) p = (p - low) / (high - low);
    chart = roundedChart(chart);
  }
  return charts;
}

glm::dvec3 unitNormal(const TrianglePositions& t) {
  const glm::dvec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  return normal / glm::length(normal);
}

bool areParallel(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::length(glm::cross(a, b)) <= angleTolerance && glm::dot(a, b) > 0;
}

std::vector<ChartedPart> planarParts(std::span<const TrianglePositions> triangles,
                                     std::span<const std::uint32_t> faces) {
  const MeshEdges edges = findEdges(triangles);
  const std::vector<glm::dvec3> normals = unitNormals(triangles);
  Parts parts(triangles, edges, faces);
  for (std::uint32_t seed = 0; seed < triangles.size(); ++seed)
    parts.add(seed, normals[seed],
              [&](std::uint32_t, std::uint32_t other) { return areParallel(normals[seed], normals[other / 3]); });
  return std::move(parts).ordered();
}

std::vector<ChartedPart> curvedParts(std::span<const TrianglePositions> triangles, const MeshEdges& edges,
                                     std::span<const std::uint32_t> faces, const Connects& isSmooth) {
  return CurvedSplitter(triangles, edges, faces, isSmooth).split();
}

}  // namespace hemitex::radiosity
