#include "data/generate/walls.h"

#include <algorithm>

#include "data/generate/curves.h"

namespace hemitex::data {
namespace {

/// The lines that bound cells, sorted; lines that differ only by rounding are merged.
std::vector<double> lines(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const auto same = [](double a, double b) { return b - a < 1e-9; };
  values.erase(std::unique(values.begin(), values.end(), same), values.end());
  return values;
}

bool contains(const Rectangle& rectangle, double s, double y) {
  return s > rectangle.left && s < rectangle.right && y > rectangle.bottom && y < rectangle.top;
}

}  // namespace

std::vector<Rectangle> cutOut(const Rectangle& whole, const std::vector<Rectangle>& holes) {
  std::vector<double> columns{whole.left, whole.right}, rows{whole.bottom, whole.top};
  for (const Rectangle& hole : holes) {
    columns.insert(columns.end(), {hole.left, hole.right});
    rows.insert(rows.end(), {hole.bottom, hole.top});
  }
  columns = lines(columns);
  rows = lines(rows);
  std::vector<Rectangle> cells;
  for (std::size_t j = 0; j + 1 < rows.size(); ++j)
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      const double s = (columns[i] + columns[i + 1]) / 2, y = (rows[j] + rows[j + 1]) / 2;
      const bool cut =
          std::any_of(holes.begin(), holes.end(), [&](const Rectangle& hole) { return contains(hole, s, y); });
      if (!cut) cells.push_back({columns[i], columns[i + 1], rows[j], rows[j + 1]});
    }
  return cells;
}

Polygon panel(const Wall& wall, const Rectangle& rectangle, double depth) {
  return pane(wall, outline(rectangle), depth);
}

std::vector<Polygon> panels(const Wall& wall, const std::vector<Rectangle>& rectangles, double depth) {
  std::vector<Polygon> result;
  for (const Rectangle& rectangle : rectangles) result.push_back(panel(wall, rectangle, depth));
  return result;
}

Outline outline(const Arch& arch) {
  Outline points;
  if (arch.sill < arch.spring) points.emplace_back(arch.centre + arch.radius, arch.sill);
  for (const glm::dvec2& point : halfCircle(arch.segments))
    points.emplace_back(arch.centre + arch.radius * point.x, arch.spring + arch.radius * point.y);
  if (arch.sill < arch.spring) points.emplace_back(arch.centre - arch.radius, arch.sill);
  return points;
}

Outline outline(const Rectangle& rectangle) {
  return {{rectangle.left, rectangle.bottom},
          {rectangle.right, rectangle.bottom},
          {rectangle.right, rectangle.top},
          {rectangle.left, rectangle.top}};
}

std::vector<Polygon> aroundArch(const Wall& wall, const Rectangle& rectangle, const Arch& arch) {
  Outline points = outline(arch);  // counter-clockwise around the opening, which is clockwise around the wall
  points.insert(points.begin(), {rectangle.right, rectangle.bottom});
  points.emplace_back(rectangle.left, rectangle.bottom);
  const std::size_t crown = points.size() / 2;
  std::vector<Polygon> result;
  const auto addTriangle = [&](const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    result.push_back({{wall.at(a.x, a.y), wall.at(b.x, b.y), wall.at(c.x, c.y)}});
  };
  const glm::dvec2 right{rectangle.right, rectangle.top}, left{rectangle.left, rectangle.top};
  for (std::size_t i = 0; i + 1 < points.size(); ++i) addTriangle(i < crown ? right : left, points[i + 1], points[i]);
  addTriangle(left, points[crown], right);
  return result;
}

std::vector<Polygon> reveal(const Wall& wall, Outline outline, double depth, bool closed) {
  if (closed) outline.push_back(outline.front());
  Rows rows(2);
  for (const glm::dvec2& point : outline) {
    rows[0].push_back(wall.at(point.x, point.y));
    rows[1].push_back(wall.at(point.x, point.y, depth));
  }
  return sheet(rows);
}

Polygon pane(const Wall& wall, const Outline& outline, double depth) {
  Polygon polygon;
  for (const glm::dvec2& point : outline) polygon.corners.push_back(wall.at(point.x, point.y, depth));
  return polygon;
}

}  // namespace hemitex::data
