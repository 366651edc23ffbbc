/// Index maps of 1 to 31 bits that use all item IDs.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace hemitex::accuracy {

struct IdCase {
  int indexBits;           ///< k
  std::string format;      ///< the narrowest format whose item IDs hold at least two surfaces of k bits
  std::uint64_t surfaces;  ///< of 2^k texels each; the last is two texels short, because two item IDs are reserved
  std::string refusal;     ///< the error message if the last surface is complete
};

/// One case for each k from 1 to 31.
std::vector<IdCase> idCases();

/// Whether each usable item ID, drawn with a clamped add, is offset + texel and decodes to that texel. The two reserved
/// item IDs must decode to nothing.
bool isOneToOne(const IdCase& example);

}  // namespace hemitex::accuracy
