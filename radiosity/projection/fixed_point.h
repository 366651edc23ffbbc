/// Shares of the flux leaving a patch in fixed point. Shares are integers, so that the order of summation does not
/// change a sum.
#pragma once

#include <cstdint>

namespace hemitex::radiosity {

/// Shares are counted in units of 2^-60.
inline constexpr int shareBits = 60;
inline constexpr std::uint64_t wholeShare = std::uint64_t{1} << shareBits;

/// The form factor of a share, in [0, 1]. Signed integers convert to double with one instruction, unsigned ones need
/// several.
inline double formFactor(std::uint64_t share) {
  return static_cast<double>(static_cast<std::int64_t>(share)) / static_cast<double>(wholeShare);
}

}  // namespace hemitex::radiosity
