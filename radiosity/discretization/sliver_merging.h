/// Sliver merging: computes the texel-to-element map. Texels that the chart covers too little merge with neighbours,
/// and texels without area map to the nearest element.
#pragma once

#include <cstdint>
#include <vector>

namespace hemitex::radiosity {

/// A covered share of a texel up to this value is rounding noise: the texel has no area, and its light goes to the
/// element that it maps to.
inline constexpr double coverageNoise = 1e-12;

/// A texel whose covered share is below this is a sliver.
inline constexpr double sliverCoverage = 0.25;

/// For each of columns x rows texels, the own texel of the element that receives its light. `coverage` is the covered
/// share of each texel, above coverageNoise for at least one.
///
/// In ascending order of coverage, each sliver merges with its largest neighbour: one of the four at its edges or, if
/// none of those has area, one of the four at its corners. The size of a neighbour is that of the group it has merged
/// into. A group that covers a quarter or more merges no further. In the end each group covers at least a quarter,
/// unless no neighbour has area. A group's own texel is the one with the largest coverage; of equals, the lowest.
std::vector<std::uint32_t> mergeSlivers(int columns, int rows, const std::vector<double>& coverage);

}  // namespace hemitex::radiosity
