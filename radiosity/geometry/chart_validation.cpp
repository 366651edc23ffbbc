#include "radiosity/geometry/chart_validation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "raster/base/cross.h"

namespace hemitex::radiosity {
namespace {

using raster::cross;

bool isInside(const ChartTriangle& triangle) {
  return std::all_of(triangle.begin(), triangle.end(),
                     [](const glm::dvec2& p) { return p.x >= 0 && p.x <= 1 && p.y >= 0 && p.y <= 1; });
}

/// Exact for rounded coordinates, whose products have 48 bits.
bool hasChartArea(const ChartTriangle& t) { return cross(t[1] - t[0], t[2] - t[0]) != 0; }

struct Interval {
  double low = 0, high = 0;
};

/// The heights of a triangle over the line from `a` to `b`, times the length of the line.
Interval heights(const ChartTriangle& t, const glm::dvec2& a, const glm::dvec2& b) {
  const std::array<double, 3> h{cross(b - a, t[0] - a), cross(b - a, t[1] - a), cross(b - a, t[2] - a)};
  return {std::min({h[0], h[1], h[2]}), std::max({h[0], h[1], h[2]})};
}

/// Whether a line along an edge of `s` separates the two, up to the tolerance.
bool partedByEdge(const ChartTriangle& s, const ChartTriangle& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a = s[i], b = s[(i + 1) % 3];
    const Interval hs = heights(s, a, b), ht = heights(t, a, b);
    const double depth = std::min(hs.high, ht.high) - std::max(hs.low, ht.low);
    if (depth <= chartTolerance * glm::length(b - a)) return true;
  }
  return false;
}

bool overlap(const ChartTriangle& s, const ChartTriangle& t) { return !partedByEdge(s, t) && !partedByEdge(t, s); }

struct Box {
  glm::dvec2 low{1.0}, high{0.0};
};

Box boxOf(const ChartTriangle& t) {
  return {glm::min(glm::min(t[0], t[1]), t[2]), glm::max(glm::max(t[0], t[1]), t[2])};
}

bool boxesOverlap(const Box& a, const Box& b) {
  return a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y && b.low.y < a.high.y;
}

/// The triangles that stay, in a uniform grid over the square. The grid has about as many cells as triangles; cells
/// have the shape of the average bounding box.
class ChartGrid {
 public:
  explicit ChartGrid(std::span<const ChartTriangle> triangles) : triangles_(triangles), seenBy_(triangles.size()) {
    glm::dvec2 sum(chartTolerance);
    for (const ChartTriangle& t : triangles) {
      if (isInside(t)) sum += boxOf(t).high - boxOf(t).low;
    }
    const auto count = static_cast<double>(triangles.size());
    columns_ = std::floor(std::clamp(std::sqrt(count * sum.y / sum.x), 1.0, count));
    rows_ = std::floor(std::clamp(std::sqrt(count * sum.x / sum.y), 1.0, count));
    cells_.resize(static_cast<std::size_t>(columns_ * rows_));
  }

  void insert(std::uint32_t triangle) {
    forCells(triangles_[triangle], [&](std::vector<std::uint32_t>& cell) {
      cell.push_back(triangle);
      return false;
    });
  }

  /// The first inserted triangle found that overlaps `triangle`.
  std::optional<std::uint32_t> overlapped(std::uint32_t triangle) {
    const Box box = boxOf(triangles_[triangle]);
    std::optional<std::uint32_t> found;
    forCells(triangles_[triangle], [&](const std::vector<std::uint32_t>& cell) {
      for (const std::uint32_t other : cell) {
        if (seenBy_[other] == triangle) continue;  // the grid is empty for triangle 0
        seenBy_[other] = triangle;
        if (!boxesOverlap(box, boxOf(triangles_[other]))) continue;
        if (overlap(triangles_[triangle], triangles_[other])) found = other;
        if (found) return true;
      }
      return false;
    });
    return found;
  }

 private:
  /// Calls visit(cell) for the cells that a triangle may touch, row by row, until one call returns true.
  template <typename Visit>
  void forCells(const ChartTriangle& t, Visit visit) {
    const Box box = boxOf(t);
    for (std::size_t row = indexOf(box.low.y, rows_); row <= indexOf(box.high.y, rows_); ++row) {
      const Interval extent = extentInRow(t, row);
      for (std::size_t c = indexOf(extent.low, columns_); c <= indexOf(extent.high, columns_); ++c) {
        if (visit(cells_[row * static_cast<std::size_t>(columns_) + c])) return;
      }
    }
  }

  static std::size_t indexOf(double coordinate, double cells) {
    return static_cast<std::size_t>(std::clamp(std::floor(coordinate * cells), 0.0, cells - 1));
  }

  /// The range of u that a triangle covers in a row, enlarged by the tolerance. Its ends are corners in the row or
  /// crossings of edges with the row's ends.
  Interval extentInRow(const ChartTriangle& t, std::size_t row) const {
    const double bottom = static_cast<double>(row) / rows_ - chartTolerance;
    const double top = static_cast<double>(row + 1) / rows_ + chartTolerance;
    Interval extent{1, 0};
    const auto add = [&](double u) { extent = {std::min(extent.low, u), std::max(extent.high, u)}; };
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::dvec2 a = t[i], b = t[(i + 1) % 3];
      if (a.y >= bottom && a.y <= top) add(a.x);
      for (const double v : {bottom, top}) {
        if ((a.y < v) != (b.y < v)) add(a.x + (v - a.y) / (b.y - a.y) * (b.x - a.x));
      }
    }
    return {extent.low - chartTolerance, extent.high + chartTolerance};
  }

  std::span<const ChartTriangle> triangles_;
  std::vector<std::uint32_t> seenBy_;  ///< for each triangle the last one that it was compared with
  double columns_ = 1, rows_ = 1;      ///< integers
  std::vector<std::vector<std::uint32_t>> cells_;
};

}  // namespace

ChartTriangle roundedChart(const ChartTriangle& triangle) {
  ChartTriangle rounded = triangle;
  for (glm::dvec2& p : rounded) p = {std::nearbyint(p.x * 0x1p24) * 0x1p-24, std::nearbyint(p.y * 0x1p24) * 0x1p-24};
  return rounded;
}

std::vector<ChartConflict> chartConflicts(std::span<const ChartTriangle> triangles, std::size_t limit,
                                          bool testsOverlap) {
  using Kind = ChartConflict::Kind;
  std::vector<ChartConflict> conflicts;
  if (triangles.empty()) return conflicts;
  ChartGrid grid(triangles);
  for (std::uint32_t i = 0; i < triangles.size() && conflicts.size() < limit; ++i) {
    if (!isInside(triangles[i])) {
      conflicts.push_back({Kind::Outside, i});
    } else if (!hasChartArea(triangles[i])) {
      conflicts.push_back({Kind::NoArea, i});
    } else if (!testsOverlap) {
      continue;
    } else if (const std::optional<std::uint32_t> other = grid.overlapped(i)) {
      conflicts.push_back({Kind::Overlap, i, *other});
    } else {
      grid.insert(i);
    }
  }
  return conflicts;
}

}  // namespace hemitex::radiosity
