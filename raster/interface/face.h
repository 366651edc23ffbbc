/// A face, which is one view of the scene (docs/item-buffers.md, "input"), and the item buffer that drawing it
/// produces.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

#include "raster/interface/item_id.h"

namespace hemitex::raster {

/// The pixels of a viewport that are drawn: columns [column, column + width), rows [row, row + height).
struct Scissor {
  int column = 0;
  int row = 0;
  int width = 0;
  int height = 0;
};

/// A view given by the rows of a matrix: x = X . d, y = Y . d, w = W . d with d = P - eye. The picture plane is w = 1.
/// The viewport of resolution x resolution pixels shows x/w and y/w from -1 to 1; row 0 is at y/w = -1. By default it
/// looks along -z with a field of view of 90 degrees.
struct Face {
  glm::vec3 eye{0, 0, 0};
  glm::vec3 x{1, 0, 0};             ///< right
  glm::vec3 y{0, 1, 0};             ///< towards larger rows
  glm::vec3 w{0, 0, -1};            ///< forward
  float nearDistance = 0x1p-10F;    ///< smallest w that is drawn; above 0
  int resolution = 256;             ///< even, 2 to 4096
  Scissor scissor{0, 0, 256, 256};  ///< inside the viewport
};

/// det(x, y, w) in double precision. Its sign determines which winding is front-facing (docs/item-buffers.md,
/// "facing").
double determinant(const Face& face);

/// Throws InputError if a member is out of its range, or if det(x, y, w) is zero or not finite.
void validate(const Face& face);

/// The item IDs of a face's scissor rectangle, row-major, row 0 first.
struct ItemBuffer {
  int width = 0;
  int height = 0;
  std::vector<ItemId> ids;

  /// Sets the size to that of a scissor rectangle. The item IDs are unspecified afterwards.
  void resize(const Scissor& scissor) {
    width = scissor.width;
    height = scissor.height;
    ids.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  }
};

}  // namespace hemitex::raster
