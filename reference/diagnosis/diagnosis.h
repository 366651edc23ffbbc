/// The diagnosis of a device whose errors are systematic: the vector is drawn again with each known fault (fault.h),
/// and the fault whose item IDs are the device's is named.
///
/// Let the footprint of a fault be the pixels where it changes the item IDs of the rules. A fault *agrees* with a
/// device as far as, of the pixels that are errors or in the footprint, the device holds the fault's item ID: a device
/// with the fault agrees but where its own small errors show, another one hardly ever.
#pragma once

#include <string>
#include <vector>

#include "reference/verdict/verdict.h"

namespace hemitex::reference {

/// A fault that the errors come from.
struct Finding {
  std::string fault;
  std::string variant;  ///< which form of the fault agrees best; may be empty
  double agreement;     ///< from 0.9 to 1
  std::string advice;   ///< where to look
};

/// The fault that agrees best, if any agrees on nine pixels of ten and on at least eight; with it those that the vector
/// cannot tell from it: no more pixels than chance allows hold the item ID of the one and not of the other. Empty where
/// nothing is an error.
std::vector<Finding> diagnose(const TestVector& vector, const Verdict& verdict);

/// "linear filtering (99.8 % agreement): set both filters ..."; several are joined with "either" and "or".
std::string toText(const std::vector<Finding>& findings);

}  // namespace hemitex::reference
