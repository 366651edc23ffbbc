/// The errors of a verdict, each with what the rules show there and what the device's word stands for.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "reference/verdict.h"
#include "reference/word_origin.h"

namespace hemitex::reference {

/// An error, with what the rules show there.
struct ErrorPixel {
  std::string face;
  int column, row;  ///< in the viewport
  raster::Word expected, found;
  WordOrigin expectedOrigin, foundOrigin;
  std::optional<Fragment> visible;  ///< none where the rules show the background
};

/// One line, without the face's name.
std::string toText(const ErrorPixel& error);

/// The first errors, face by face and row by row, at most `count` of them.
std::vector<ErrorPixel> firstErrors(const TestVector& vector, const Verdict& verdict, std::size_t count = 10);

}  // namespace hemitex::reference
