/// Formats numbers for the page.
#pragma once

#include <string>

namespace hemitex::accuracy {

/// Up to four digits: 0.1998, 1e-6, 1e30.
std::string numberText(double number);

/// An error rounded up to one digit. "0" is exactly 0; rounding errors are "< 1e-10".
std::string errorText(double error);

}  // namespace hemitex::accuracy
