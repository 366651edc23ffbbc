#include "data/generate/curves.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "data/generate/shapes.h"

namespace hemitex::data {
namespace {

/// Four decimals keep files short.
double roundedCoordinate(double t) { return std::nearbyint(t * 1e4) / 1e4; }

/// From 0 to 1, in steps proportional to `lengths`.
std::vector<double> cumulated(const std::vector<double>& lengths) {
  double total = 0;
  for (const double length : lengths) total += length;
  std::vector<double> result{0};
  double sum = 0;
  for (const double length : lengths) result.push_back(roundedCoordinate((sum += length) / total));
  return result;
}

/// The triangle of these nodes, unless two of its corners coincide.
void addTriangle(std::vector<Polygon>& triangles, const std::array<glm::dvec3, 3>& corners,
                 const std::array<glm::dvec2, 3>& texcoords) {
  for (std::size_t i = 0; i < 3; ++i)
    if (glm::distance(corners[i], corners[(i + 1) % 3]) < 1e-9) return;
  triangles.push_back({{corners.begin(), corners.end()}, {texcoords.begin(), texcoords.end()}});
}

}  // namespace

std::vector<glm::dvec2> circle(int n) {
  std::vector<glm::dvec2> points;
  int corners = n;
  while (corners > 5) {
    assert(corners % 2 == 0);
    corners /= 2;
  }
  const double root5 = std::sqrt(5.0);
  if (corners == 3) points = {{1, 0}, {-0.5, std::sqrt(0.75)}, {-0.5, -std::sqrt(0.75)}};
  if (corners == 4) points = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  if (corners == 5) {
    const double c1 = (root5 - 1) / 4, c2 = -(root5 + 1) / 4;  // the cosines of 72 and 144 degrees
    const double s1 = std::sqrt(1 - c1 * c1), s2 = std::sqrt(1 - c2 * c2);
    points = {{1, 0}, {c1, s1}, {c2, s2}, {c2, -s2}, {c1, -s1}};
  }
  assert(!points.empty());
  while (static_cast<int>(points.size()) < n) {
    std::vector<glm::dvec2> twice;
    for (std::size_t i = 0; i < points.size(); ++i) {
      twice.push_back(points[i]);
      const glm::dvec2 middle = points[i] + points[(i + 1) % points.size()];
      twice.push_back(middle / std::sqrt(middle.x * middle.x + middle.y * middle.y));
    }
    points = twice;
  }
  return points;
}

std::vector<glm::dvec2> halfCircle(int n) {
  const std::vector<glm::dvec2> whole = circle(2 * n);
  return {whole.begin(), whole.begin() + n + 1};
}

std::vector<Polygon> sheet(const Rows& rows) {
  const std::size_t columns = rows[0].size() - 1;
  std::vector<double> widths(columns, 0.0), heights(rows.size() - 1, 0.0);
  for (std::size_t j = 0; j < rows.size(); ++j)
    for (std::size_t i = 0; i <= columns; ++i) {
      if (i < columns) widths[i] += glm::distance(rows[j][i], rows[j][i + 1]);
      if (j + 1 < rows.size()) heights[j] += glm::distance(rows[j][i], rows[j + 1][i]);
    }
  const std::vector<double> u = cumulated(widths), v = cumulated(heights);
  std::vector<Polygon> triangles;
  for (std::size_t j = 0; j + 1 < rows.size(); ++j)
    for (std::size_t i = 0; i < columns; ++i) {
      const glm::dvec3 a = rows[j][i], b = rows[j][i + 1], c = rows[j + 1][i + 1], d = rows[j + 1][i];
      const glm::dvec2 ta{u[i], v[j]}, tb{u[i + 1], v[j]}, tc{u[i + 1], v[j + 1]}, td{u[i], v[j + 1]};
      addTriangle(triangles, {a, b, c}, {ta, tb, tc});
      addTriangle(triangles, {a, c, d}, {ta, tc, td});
    }
  return triangles;
}

std::vector<Polygon> revolved(const std::vector<ProfilePoint>& profile, int n, const glm::dvec3& foot) {
  const std::vector<glm::dvec2> points = circle(n);
  Rows rows;
  for (const ProfilePoint& point : profile) {
    std::vector<glm::dvec3>& row = rows.emplace_back();
    for (std::size_t i = 0; i <= points.size(); ++i) {
      const glm::dvec2 direction = points[i % points.size()];
      row.push_back(foot + glm::dvec3(point.radius * direction.x, point.height, -point.radius * direction.y));
    }
  }
  return sheet(rows);
}

Polygon disc(const glm::dvec3& centre, double radius, int n) {
  Polygon polygon;
  for (const glm::dvec2& point : circle(n))
    polygon.corners.push_back(centre + radius * glm::dvec3(point.x, 0, -point.y));
  return polygon;
}

std::vector<Polygon> band(const Polygon& top, double y) {
  std::vector<glm::dvec3> upper = top.corners;
  upper.push_back(upper.front());
  std::vector<glm::dvec3> lower = atHeight(top, y).corners;
  lower.push_back(lower.front());
  return sheet({lower, upper});
}

std::vector<Polygon> ring(const Polygon& outer, const Polygon& inner) {
  const std::size_t count = inner.corners.size();
  const bool twice = outer.corners.size() == 2 * count;
  assert(twice || outer.corners.size() == count);
  std::vector<Polygon> result;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 in = inner.corners[i], nextIn = inner.corners[(i + 1) % count];
    if (twice) {
      const glm::dvec3 first = outer.corners[2 * i], middle = outer.corners[2 * i + 1];
      const glm::dvec3 last = outer.corners[(2 * i + 2) % outer.corners.size()];
      for (const Polygon& triangle : {Polygon{{first, middle, in}}, {{middle, nextIn, in}}, {{middle, last, nextIn}}})
        result.push_back(triangle);
    } else {
      result.push_back({{outer.corners[i], outer.corners[(i + 1) % count], nextIn, in}});
    }
  }
  return result;
}

std::vector<Polygon> squareWithHole(const glm::dvec3& centre, double halfSide, double radius, int n) {
  const Polygon square =
      rectangle(centre.x - halfSide, centre.x + halfSide, centre.z - halfSide, centre.z + halfSide, centre.y);
  const std::vector<glm::dvec3> hole = disc(centre, radius, n).corners;
  const std::size_t count = hole.size(), quarter = count / 4;
  // The square's first corner lies at -x and +z, at 5/8 of the circle.
  const auto at = [&](std::size_t i) { return hole[(i + 5 * count / 8) % count]; };
  std::vector<Polygon> result;
  for (std::size_t side = 0; side < 4; ++side) {
    const glm::dvec3 corner = square.corners[side], next = square.corners[(side + 1) % 4];
    const std::size_t first = side * quarter, middle = first + quarter / 2;
    for (std::size_t i = first; i < first + quarter; ++i)
      result.push_back({{i < middle ? corner : next, at(i + 1), at(i)}});
    result.push_back({{corner, next, at(middle)}});
  }
  return result;
}

std::vector<Polygon> reversed(const std::vector<Polygon>& polygons) {
  std::vector<Polygon> result;
  for (const Polygon& polygon : polygons) result.push_back(reversed(polygon));
  return result;
}

}  // namespace hemitex::data
