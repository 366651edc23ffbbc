/// The nearest covered texel of each texel of a grid: an exact Euclidean distance transform (Felzenszwalb and
/// Huttenlocher 2012) in integers, in linear time.
#pragma once

#include <cstdint>
#include <vector>

namespace hemitex::radiosity {

/// The most columns and rows of a grid, and the most texels.
inline constexpr int longestGridSide = 1 << 18, mostGridTexels = 1 << 24;

/// Returns for each of columns x rows texels (row-major, within the limits above) the covered texel with the nearest
/// centre; of equals, the lowest number. At least one texel must be covered.
std::vector<std::uint32_t> nearestCovered(int columns, int rows, const std::vector<bool>& covered);

}  // namespace hemitex::radiosity
