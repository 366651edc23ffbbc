/// Numbers in messages.
#pragma once

#include <string>

namespace hemitex::raster {

/// A number with three digits.
std::string shortNumber(double value);

}  // namespace hemitex::raster
