/// A face, which is one view of the scene (docs/item-buffers.md, "input"), and the item buffer that drawing it
/// produces.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
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

/// The maximum number of columns or rows of a viewport.
inline constexpr int maxSide = 16384;

/// The size of a viewport that is no square of an even number of pixels (version 2).
struct Viewport {
  int columns = 0, rows = 0;  ///< 1 to maxSide each
  bool operator==(const Viewport&) const = default;
};

/// Where in a pixel its sample is: in the middle, or at the corner of its smallest column and row (version 2).
enum class SamplePlace : std::uint8_t { Middle, Corner };

/// A view given by the rows of a matrix: x = X . d, y = Y . d, w = W . d with d = P - eye. The picture plane is w = 1.
/// The viewport of resolution x resolution pixels shows x/w and y/w from -1 to 1; row 0 is at y/w = -1. By default it
/// looks along -z with a field of view of 90 degrees.
struct Face {
  glm::vec3 eye{0, 0, 0};
  glm::vec3 x{1, 0, 0};                   ///< right
  glm::vec3 y{0, 1, 0};                   ///< towards larger rows
  glm::vec3 w{0, 0, -1};                  ///< forward
  float nearDistance = 0x1p-10F;          ///< smallest w that is drawn; above 0
  int resolution = 256;                   ///< even, 2 to 4096
  Scissor scissor{0, 0, 256, 256};        ///< inside the viewport
  std::optional<Viewport> viewport = {};  ///< in place of the square of `resolution`
  SamplePlace sample = SamplePlace::Middle;
};

/// The columns and rows of a face.
inline Viewport viewportOf(const Face& face) {
  return face.viewport.value_or(Viewport{face.resolution, face.resolution});
}

/// det(x, y, w) in double precision. Its sign determines which winding is front-facing (docs/item-buffers.md,
/// "facing").
double determinant(const Face& face);

/// Throws InputError if a member is out of its range, or if det(x, y, w) is zero or not finite.
void validate(const Face& face);

/// Whether the face has no viewport of its own, and samples in the middle of pixels. SoftwareRenderer draws no others.
bool isUsual(const Face& face);
/// Throws InputError for any other face.
void requireUsual(const Face& face);

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
