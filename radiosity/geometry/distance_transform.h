/// The nearest covered texel of every texel of a grid: an exact Euclidean distance transform (Felzenszwalb and
/// Huttenlocher 2012) in integers, in a time proportional to the number of texels.
#pragma once

#include <cstdint>
#include <vector>

namespace hemitex::radiosity {

/// For each of columns x rows texels (row-major, at most 4096 x 4096) the covered texel whose centre is nearest, the
/// lowest of equals; a covered texel is its own. At least one texel is covered.
std::vector<std::uint32_t> nearestCovered(int columns, int rows, const std::vector<bool>& covered);

}  // namespace hemitex::radiosity
