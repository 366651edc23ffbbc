/// A face: one view of the scene (raster rules, 1), and the item buffer that drawing it gives.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::raster {

/// The pixels of a viewport that exist: columns [column, column + width), rows [row, row + height).
struct Scissor {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
};

/// A view through the rows of a matrix: x = X . d, y = Y . d, w = W . d with d = P - eye. The picture plane is w = 1,
/// and the viewport of resolution x resolution pixels shows x/w and y/w from -1 to 1; y/w = -1 is row 0.
struct Face {
  glm::vec3 eye;
  glm::vec3 x;             ///< right
  glm::vec3 y;             ///< in row order
  glm::vec3 w;             ///< forward
  float nearDistance = 0;  ///< in w; above 0
  int resolution = 0;      ///< even, 2 to 4096
  Scissor scissor;         ///< inside the viewport
};

/// det(x, y, w) in binary64: its sign says which winding faces the eye (raster rules, 5).
double determinant(const Face& face);

/// Throws InputError where a face breaks the rules above or det(x, y, w) is zero or not finite.
void validate(const Face& face);

/// The item IDs of a face's scissor rectangle, row-major, row 0 first.
struct ItemBuffer {
  int width = 0;
  int height = 0;
  std::vector<ItemId> ids;

  /// As large as a scissor rectangle; which item IDs it holds is open.
  void resize(const Scissor& scissor) {
    width = scissor.width;
    height = scissor.height;
    ids.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
};

}  // namespace hemitex::raster
