/// A number that knows how wrong it may be: what is computed in binary64 is kept where that suffices, and computed
/// again in wider arithmetic where it does not.
#pragma once

namespace hemitex::reference {

template <typename Real>
struct Estimate {
  Real value = 0;
  Real error = 0;  ///< how far rounding and the rule may have moved it, at most

  /// Whether it is positive, and right to 1e-10 of itself; true for an exact 0.
  bool isCertain() const { return error <= 1e-10 * value; }
};

}  // namespace hemitex::reference
