/// The spill: where each texel's light goes. Texels of which the chart covers too little merge with neighbours, and
/// texels without area give their light to the nearest element.
#pragma once

#include <cstdint>
#include <vector>

namespace hemitex::radiosity {

/// A covered share of a texel at or below this is rounding noise: such a texel has no area, and what was counted into
/// it goes where it spills to.
inline constexpr double coverageNoise = 1e-12;

/// A texel whose covered share is below this is a sliver.
inline constexpr double sliverCoverage = 0.25;

/// For each of columns x rows texels the own texel of the element that takes its light; `coverage` is the covered
/// share of each texel, above coverageNoise for one at least.
///
/// In ascending order of coverage, each sliver merges with its largest neighbour: of the four that share an edge with
/// it, or, where none of them has area, of the four at its corners. Neighbours count as large as the group they have
/// merged into, and a group that has reached a quarter merges no further. In the end no group is below a quarter but
/// where no neighbour has area. A group's own texel is the one of largest coverage. The lowest texel of equals wins.
std::vector<std::uint32_t> spillTexels(int columns, int rows, const std::vector<double>& coverage);

}  // namespace hemitex::radiosity
