/// Index maps of 1 to 31 bits, and item IDs filled to the last bit.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hemitex::accuracy {

struct IdCase {
  int indexBits;           ///< k
  std::string format;      ///< the narrowest whose item IDs k bits fill with at least two surfaces
  std::uint64_t surfaces;  ///< of 2^k texels each, but for the last, which is two short: these item IDs are reserved
  std::string refusal;     ///< what the user is told where the last has its two texels, too
};

/// One for every k from 1 to 31, laid out and refused.
std::vector<IdCase> idCases();

/// Whether every texel's item ID, drawn with a clamped add, is offset + texel and stands for that texel, from the first
/// to the last item ID of use, and nothing stands for the two behind.
bool isOneToOne(const IdCase& example);

}  // namespace hemitex::accuracy
