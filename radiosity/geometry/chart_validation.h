/// Validates charts: texture coordinates that map a surface into [0,1]^2 so that each texel belongs to one place of the
/// surface.
///
/// A set of coordinates is a chart if each triangle lies inside the square and has area there, and no two triangles
/// overlap. Coordinates are drawn in binary32, so they are rounded to multiples of 2^-24, which binary32 represents
/// exactly. Files print six decimals. Neither rounding may count as an overlap. So two triangles overlap only if they
/// penetrate each other by more than `chartTolerance`: no line along one of their six edges separates them up to that
/// depth (separating axis theorem). Charts may be mirrored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

/// 1.9e-6. A corner and its edge may each be off by half a unit of the sixth decimal in u and v. Together that is
/// sqrt(2) 1e-6. Rounding adds less than 1e-7.
inline constexpr double chartTolerance = 0x1p-19;

using ChartTriangle = std::array<glm::dvec2, 3>;

/// Rounds coordinates to multiples of 2^-24.
ChartTriangle roundedChart(const ChartTriangle& triangle);

/// A triangle that cannot share a chart with the triangles before it.
struct ChartConflict {
  enum class Kind { Outside, NoArea, Overlap };
  Kind kind = Kind::Overlap;
  std::uint32_t triangle = 0;
  std::uint32_t other = 0;  ///< the earlier triangle that it overlaps
};

/// Returns the triangles to remove, ascending, so that the rest is a chart. Each triangle is tested against the earlier
/// ones that stay, unless `testsOverlap` is false: they are known not to overlap. Stops at `limit` conflicts.
/// Coordinates must be rounded. Takes linear time for triangles of about equal size.
std::vector<ChartConflict> chartConflicts(std::span<const ChartTriangle> triangles, std::size_t limit = SIZE_MAX,
                                          bool testsOverlap = true);

}  // namespace hemitex::radiosity
