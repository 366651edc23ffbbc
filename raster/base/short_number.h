/// Numbers as text.
#pragma once

#include <string>

namespace hemitex::raster {

/// A number with three digits, for messages.
std::string shortNumber(double value);

/// The shortest decimal that reads back to the same number, for files. Independent of the locale.
std::string toText(double value);
std::string toText(float value);

}  // namespace hemitex::raster
