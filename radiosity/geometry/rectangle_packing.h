/// Packing rectangles into as few square pages as a skyline can: what lies where is a function of the sizes and their
/// order alone, the same on every machine.
#pragma once

#include <vector>

namespace hemitex::radiosity {

struct RectangleSize {
  int width = 0;
  int height = 0;
};

/// The lower left corner of a rectangle; a rectangle is never rotated.
struct RectanglePlace {
  int page = 0;
  int column = 0;
  int row = 0;
};

struct Packing {
  std::vector<RectangleSize> pages;
  std::vector<RectanglePlace> places;  ///< one a rectangle
};

/// No two rectangles overlap. Pages are squares of `largestSide`, a power of two; the last is the smallest power of
/// two that holds what is left. A rectangle wider or higher than that has a page of its own size, after the others.
Packing packRectangles(const std::vector<RectangleSize>& sizes, int largestSide);

}  // namespace hemitex::radiosity
