/// Charts: when do coordinates map a surface into [0,1]^2 so that every texel belongs to one place of the surface?
///
/// They do when every triangle lies inside the square, has area there, and no two overlap. Coordinates are drawn in
/// binary32, so they are rounded to multiples of 2^-24, which all are binary32 numbers, and files print six decimals:
/// neither is to make an overlap. So two triangles overlap only where they penetrate each other by more than
/// `chartTolerance`, that is where no line along one of their six edges parts them up to that depth (separating axes).
/// Charts may be mirrored.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace hemitex::radiosity {

/// 1.9e-6. A corner and the edge that it should lie on may each be off by half a unit of the sixth decimal in u and v,
/// which together is sqrt(2) 1e-6; rounding adds less than 1e-7 to that.
inline constexpr double chartTolerance = 0x1p-19;

using ChartTriangle = std::array<glm::dvec2, 3>;

/// Coordinates rounded to multiples of 2^-24.
ChartTriangle roundedChart(const ChartTriangle& triangle);

/// A triangle that cannot share a chart with those before it.
struct ChartConflict {
  enum class Kind { Outside, NoArea, Overlap };
  Kind kind = Kind::Overlap;
  std::uint32_t triangle = 0;
  std::uint32_t other = 0;  ///< the earlier triangle that it overlaps
};

/// The triangles, of rounded coordinates, that have to go, in their order, so that the rest is a chart: each is judged
/// against those before it that stay. Stops at `limit` of them. Time grows with the triangles where they are about
/// equally large.
std::vector<ChartConflict> chartConflicts(std::span<const ChartTriangle> triangles, std::size_t limit = SIZE_MAX);

}  // namespace hemitex::radiosity
