/// Packs rectangles into few square pages with the skyline method. The result depends only on the sizes and their
/// order, the same on all machines.
#pragma once

#include <vector>

namespace hemitex::radiosity {

struct RectangleSize {
  int width = 0;
  int height = 0;
};

/// The lower left corner of a rectangle; rectangles are never rotated.
struct RectanglePlace {
  int page = 0;
  int column = 0;
  int row = 0;
};

struct Packing {
  std::vector<RectangleSize> pages;
  std::vector<RectanglePlace> places;  ///< one per rectangle
};

/// Packs rectangles without overlap. Pages are squares of `largestSide`, a power of two. The last page is the smallest
/// power of two that holds the rest. A rectangle wider or higher than `largestSide` gets a page of its own size behind
/// the others.
Packing packRectangles(const std::vector<RectangleSize>& sizes, int largestSide);

}  // namespace hemitex::radiosity
