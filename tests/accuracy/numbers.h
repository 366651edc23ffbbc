/// Numbers as the page writes them.
#pragma once

#include <string>

namespace hemitex::accuracy {

/// Up to four digits: 0.1998, 1e-6, 1e30.
std::string numberText(double number);

/// An error rounded up to one digit: at most that much. "0" is exactly 0; what rounding makes is "< 1e-10".
std::string errorText(double error);

}  // namespace hemitex::accuracy
