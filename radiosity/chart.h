/// Charts: when do coordinates map a surface into [0,1]^2 so that every texel belongs to one place of the surface?
///
/// They do when every triangle lies inside the square, has area there, and no two overlap. Coordinates are rounded to
/// binary32, because that is what is drawn, and files print six digits: neither is to make an overlap. So two
/// triangles overlap only where they penetrate each other by more than `chartTolerance`, that is where no line along
/// one of their six edges parts them up to that depth (separating axes), and a triangle has area where its height over
/// its longest edge is above the same tolerance. Charts may be mirrored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

/// 2^-20: half a unit of the sixth decimal, and eight units in the last place of binary32 below 1.
inline constexpr double chartTolerance = 0x1p-20;

using ChartTriangle = std::array<glm::dvec2, 3>;

/// Coordinates rounded to binary32.
ChartTriangle roundedChart(const ChartTriangle& triangle);

/// A triangle that cannot share a chart with those before it.
struct ChartConflict {
  enum class Kind { Outside, NoArea, Overlap };
  Kind kind = Kind::Overlap;
  std::uint32_t triangle = 0;
  std::uint32_t other = 0;  ///< the earlier triangle that it overlaps
};

/// The triangles that have to go, in their order, so that the rest is a chart: each is judged against those before it
/// that stay. Stops at `limit` of them. Time grows with the triangles where they are about equally large.
std::vector<ChartConflict> chartConflicts(std::span<const ChartTriangle> triangles, std::size_t limit = SIZE_MAX);

}  // namespace hemitex::radiosity
