#include "reference/conformance/pictures/verdict_picture.h"

#include <algorithm>

namespace hemitex::reference {
namespace {

using raster::ItemId;

constexpr int gap = 4;  // pixels between pictures

/// A colour per item ID: its bits, mixed by odd multipliers (any will do) and cut in three.
glm::dvec3 falseColour(ItemId id) {
  std::uint32_t mixed = id * 2654435769u;
  mixed = (mixed ^ (mixed >> 15)) * 2246822519u;
  mixed ^= mixed >> 13;
  const glm::dvec3 bits(mixed & 255, (mixed >> 8) & 255, (mixed >> 16) & 255);
  return 0.1 + 0.9 * bits / 255.0;
}

glm::dvec3 colourOf(PixelVerdict verdict) {
  switch (verdict) {
    case PixelVerdict::Exact:
      return glm::dvec3(0.04);
    case PixelVerdict::Coverage:
      return {0.02, 0.2, 1};
    case PixelVerdict::Texel:
      return {0, 0.6, 0.1};
    case PixelVerdict::Depth:
      return {1, 0.8, 0};
    case PixelVerdict::LooseClipping:
      return {0.5, 0.1, 0.8};
    case PixelVerdict::Error:
      return {1, 0, 0};
  }
  return {};
}

/// Paints the pixels of a face with `colour(pixel)`, its first at (left, top).
template <typename Colour>
void paint(radiosity::Image& picture, const FaceVerdict& face, int left, int top, const Colour& colour) {
  std::size_t pixel = 0;
  for (int row = 0; row < face.scissor.height; ++row) {
    const std::size_t line = static_cast<std::size_t>(top + row) * static_cast<std::size_t>(picture.width);
    for (int column = 0; column < face.scissor.width; ++column)
      picture.pixels[line + static_cast<std::size_t>(left + column)] = colour(pixel++);
  }
}

}  // namespace

radiosity::Image toPicture(const Verdict& verdict, ItemId background) {
  int width = 0, height = -gap;
  for (const FaceVerdict& face : verdict.faces) {
    width = std::max(width, 3 * face.scissor.width + 2 * gap);
    height += face.scissor.height + gap;
  }
  radiosity::Image picture{width, height, {}};
  picture.pixels.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), glm::dvec3(1.0));
  const auto colourOfId = [=](ItemId id) { return id == background ? glm::dvec3(0.0) : falseColour(id); };
  int top = 0;
  for (const FaceVerdict& face : verdict.faces) {
    const int step = face.scissor.width + gap;
    paint(picture, face, 0, top, [&](std::size_t pixel) { return colourOfId(face.expected.ids[pixel]); });
    paint(picture, face, step, top, [&](std::size_t pixel) { return colourOfId(face.found.ids[pixel]); });
    paint(picture, face, 2 * step, top, [&](std::size_t pixel) { return colourOf(face.pixels[pixel]); });
    top += face.scissor.height + gap;
  }
  return picture;
}

}  // namespace hemitex::reference
