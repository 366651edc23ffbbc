/// Faults of views and pictures. A flipped view differs from a flipped picture: the scissor rectangle of a side face
/// keeps one half of the viewport, and a flipped view shows the other half of the scene in it.
#include <algorithm>
#include <utility>

#include "raster/base/short_number.h"
#include "reference/conformance/diagnosis/fault.h"

namespace hemitex::reference {
namespace {

using raster::Face;

/// Applies `change` to the view of face `which`, or of every face if `which` is negative.
template <typename Change>
StagedDevice withViews(int which, const Change& change) {
  return withStage(&StagedDevice::camera, [=](std::span<const Face> faces, std::size_t f) {
    Face face = faces[f];
    if (which < 0 || f == static_cast<std::size_t>(which)) change(face);
    return face;
  });
}

/// A flip of the view reverses windings; a backend may or may not reverse its front face.
template <typename Change>
std::vector<Variant> flippedViews(const Change& change) {
  const StagedDevice device = withViews(-1, change);
  StagedDevice turnedOver = device;
  turnedOver.facing = [](Facing side, const Face&) { return otherSide(side); };
  return {{"", device}, {"and with it the winding of front faces", turnedOver}};
}

/// Face f drawn through the view of order[f].
Variant reordered(const std::string& name, const std::vector<std::size_t>& order) {
  const auto camera = [=](std::span<const Face> faces, std::size_t f) { return faces[order[f]]; };
  return {name, withStage(&StagedDevice::camera, camera)};
}

/// Every exchange of two faces, every rotation of all faces, and every rotation of the sides (all faces but the first).
std::vector<Variant> reorderings(const std::vector<VectorFace>& faces) {
  std::vector<std::size_t> order(faces.size());
  for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
  std::vector<Variant> variants;
  for (std::size_t a = 0; a < order.size(); ++a)
    for (std::size_t b = a + 1; b < order.size(); ++b) {
      std::vector<std::size_t> exchanged = order;
      std::swap(exchanged[a], exchanged[b]);
      variants.push_back(reordered(faces[a].name + " and " + faces[b].name, exchanged));
    }
  for (const std::size_t fixed : {0u, 1u})
    for (std::size_t steps = 1; fixed + steps < order.size(); ++steps) {
      std::vector<std::size_t> rotated = order;
      std::rotate(rotated.begin() + static_cast<std::ptrdiff_t>(fixed),
                  rotated.begin() + static_cast<std::ptrdiff_t>(fixed + steps), rotated.end());
      variants.push_back(reordered((fixed == 0 ? "all" : "the sides") + (" by " + std::to_string(steps)), rotated));
    }
  return variants;
}

/// Views rotated about their axes by quarter turns: each single face, or all of them.
std::vector<Variant> turns(const std::vector<VectorFace>& faces) {
  std::vector<Variant> variants;
  for (int which = faces.size() > 1 ? -1 : 0; which < static_cast<int>(faces.size()); ++which)
    for (int quarters = 1; quarters < 4; ++quarters) {
      const std::string name = which < 0 ? "all" : faces[static_cast<std::size_t>(which)].name;
      variants.push_back({name + " by " + std::to_string(90 * quarters) + " degrees", withViews(which, [=](Face& face) {
                            for (int k = 0; k < quarters; ++k)
                              face = {face.eye, face.y, -face.x, face.w, face.nearDistance, 0, {}};
                          })});
    }
  return variants;
}

/// Changes the view so that what it shows at position p of the viewport, in pixels, moves to stretch * p + shift.
void place(Face& face, const glm::vec2& stretch, const glm::vec2& shift) {
  const glm::vec2 middle = stretch + 2.0f * shift / static_cast<float>(face.resolution) - 1.0f;
  face.x = stretch.x * face.x + middle.x * face.w;
  face.y = stretch.y * face.y + middle.y * face.w;
}

glm::vec2 cornerOf(const Face& face) { return {face.scissor.column, face.scissor.row}; }

StagedDevice withScissorAsViewport() {
  return withViews(-1, [](Face& face) {
    const glm::vec2 size(face.scissor.width, face.scissor.height);
    place(face, size / static_cast<float>(face.resolution), cornerOf(face));
  });
}

/// Writes the background where isCleared(column and row).
template <typename IsCleared>
void clearWhere(raster::ItemBuffer& buffer, raster::ItemId background, const IsCleared& isCleared) {
  for (int row = 0, pixel = 0; row < buffer.height; ++row)
    for (int column = 0; column < buffer.width; ++column, ++pixel)
      if (isCleared(glm::vec2(column, row))) buffer.ids[static_cast<std::size_t>(pixel)] = background;
}

/// The viewport has `ratio` times its resolution. The pixels are read at the scissor rectangle's corner, or at that
/// corner times the ratio. Beyond the viewport there is background.
Variant withScaledViewport(const std::string& name, float ratio, bool isCornerScaled, raster::ItemId background) {
  const auto firstPixel = [=](const Face& face) { return (isCornerScaled ? ratio : 1.0f) * cornerOf(face); };
  StagedDevice device =
      withViews(-1, [=](Face& face) { place(face, glm::vec2(ratio), cornerOf(face) - firstPixel(face)); });
  if (ratio < 1)
    device.readBack = [=](const Face& face, raster::ItemBuffer& buffer) {
      const glm::vec2 end = ratio * static_cast<float>(face.resolution) - firstPixel(face);
      clearWhere(buffer, background, [=](const glm::vec2& pixel) { return pixel.x >= end.x || pixel.y >= end.y; });
    };
  return {name, device};
}

std::vector<Variant> scaledViewports(raster::ItemId background) {
  std::vector<Variant> variants;
  for (const float ratio : {0.5f, 0.75f, 1.25f, 1.5f, 1.75f, 2.0f, 2.5f, 3.0f})
    for (const bool isCornerScaled : {false, true})
      variants.push_back(
          withScaledViewport(raster::shortNumber(ratio) + (isCornerScaled ? ", and the corner that is read" : ""),
                             ratio, isCornerScaled, background));
  return variants;
}

/// Reads the pixels from the first corner of the viewport instead of the scissor rectangle's. A scissor test leaves
/// background outside of the rectangle.
std::vector<Variant> readBackFromFirst(raster::ItemId background) {
  const StagedDevice untested = withViews(-1, [](Face& face) { place(face, {1, 1}, cornerOf(face)); });
  StagedDevice tested = untested;
  tested.readBack = [=](const Face& face, raster::ItemBuffer& buffer) {
    const glm::vec2 corner = cornerOf(face);
    clearWhere(buffer, background, [=](const glm::vec2& pixel) { return pixel.x < corner.x || pixel.y < corner.y; });
  };
  return {{"drawn without a scissor test", untested}, {"drawn with a scissor test", tested}};
}

/// Faces that show an earlier one: the first, or the one before.
std::vector<Variant> staleFaces(std::size_t faces) {
  if (faces < 2) return {};
  std::vector<std::size_t> oneLate{0};
  for (std::size_t f = 1; f < faces; ++f) oneLate.push_back(f - 1);
  return {reordered("the first", std::vector<std::size_t>(faces)), reordered("the one before", oneLate)};
}

/// Drawn with a part of the resolution, and each pixel enlarged to a square.
Variant enlarged(int factor) {
  const float ratio = 1 / static_cast<float>(factor);
  const auto firstPixel = [=](const Face& face) {
    return glm::ivec2(face.scissor.column / factor, face.scissor.row / factor);
  };
  StagedDevice device =
      withViews(-1, [=](Face& face) { place(face, glm::vec2(ratio), cornerOf(face) - glm::vec2(firstPixel(face))); });
  device.readBack = [=](const Face& face, raster::ItemBuffer& buffer) {
    const std::vector<raster::ItemId> small = buffer.ids;
    for (std::size_t pixel = 0; pixel < small.size(); ++pixel) {
      const glm::ivec2 from = pixelAt(face.scissor, pixel) / factor - firstPixel(face);
      buffer.ids[pixel] = small[static_cast<std::size_t>(from.y * buffer.width + from.x)];
    }
  };
  return {"by " + std::to_string(factor), device};
}

/// Item IDs that grow over their neighbours, as passes that close gaps do.
std::vector<Variant> dilations(raster::ItemId background) {
  const auto with = [=](bool fillsOnlyBackground) {
    return withReadBack([=](const Face&, raster::ItemBuffer& buffer) {
      const std::vector<raster::ItemId> ids = buffer.ids;
      for (int row = 0, pixel = 0; row < buffer.height; ++row)
        for (int column = 0; column < buffer.width; ++column, ++pixel) {
          raster::ItemId& id = buffer.ids[static_cast<std::size_t>(pixel)];
          if (fillsOnlyBackground && id != background) continue;
          for (int y = std::max(row - 1, 0); y <= std::min(row + 1, buffer.height - 1); ++y)
            for (int x = std::max(column - 1, 0); x <= std::min(column + 1, buffer.width - 1); ++x)
              if (const raster::ItemId near = ids[static_cast<std::size_t>(y * buffer.width + x)]; near != background)
                id = id == background ? near : std::max(id, near);
        }
    });
  };
  return {{"the largest of 3 x 3 pixels", with(false)}, {"into the background", with(true)}};
}

/// Pictures moved by up to half a pixel: the first eight points of the sequence of Halton in bases 2 and 3, with rows
/// downwards or upwards, and four quarters.
std::vector<Variant> jitters() {
  std::vector<glm::vec2> shifts{{0.25f, 0.25f}, {-0.25f, 0.25f}, {0.25f, -0.25f}, {-0.25f, -0.25f}};
  const auto reversedDigits = [](int number, int base) {
    float value = 0, digit = 1;
    for (; number > 0; number /= base) value += static_cast<float>(number % base) * (digit /= static_cast<float>(base));
    return value;
  };
  for (int k = 1; k <= 8; ++k)
    for (const float sign : {1.0f, -1.0f})
      shifts.emplace_back(reversedDigits(k, 2) - 0.5f, sign * (reversedDigits(k, 3) - 0.5f));
  std::vector<Variant> variants;
  for (const glm::vec2& shift : shifts)
    variants.push_back({"by " + raster::shortNumber(shift.x) + ", " + raster::shortNumber(shift.y) + " pixel",
                        withViews(-1, [=](Face& face) {
                          place(face, {1, 1}, shift);
                        })});
  return variants;
}

/// Pictures moved by a pixel; what comes from outside is the scene or background.
std::vector<Variant> pixelShifts(raster::ItemId background) {
  std::vector<Variant> variants;
  for (int k = 0; k < 9; ++k) {
    const glm::ivec2 shift(k % 3 - 1, k / 3 - 1);
    if (k == 4) continue;
    const std::string name = std::to_string(shift.x) + ", " + std::to_string(shift.y);
    variants.push_back({name, withViews(-1, [=](Face& face) { place(face, {1, 1}, shift); })});
    variants.push_back({name + ", background beyond", withReadBack([=](const Face&, raster::ItemBuffer& buffer) {
                          const std::vector<raster::ItemId> ids = buffer.ids;
                          for (int row = 0, pixel = 0; row < buffer.height; ++row)
                            for (int column = 0; column < buffer.width; ++column, ++pixel) {
                              const int x = column - shift.x, y = row - shift.y;
                              const bool isInside = x >= 0 && y >= 0 && x < buffer.width && y < buffer.height;
                              buffer.ids[static_cast<std::size_t>(pixel)] =
                                  isInside ? ids[static_cast<std::size_t>(y * buffer.width + x)] : background;
                            }
                        })});
  }
  return variants;
}

StagedDevice withFirstEye() {
  return withStage(&StagedDevice::camera, [](std::span<const Face> faces, std::size_t f) {
    Face face = faces[f];
    face.eye = faces[0].eye;
    return face;
  });
}

/// Reverses the rows or the columns of the item ID file.
StagedDevice withPicture(bool reversedRows) {
  return withReadBack([=](const Face&, raster::ItemBuffer& buffer) {
    std::vector<raster::ItemId>& ids = buffer.ids;
    // Reversing all item IDs reverses rows and columns; reversing each row then restores the columns.
    if (reversedRows) std::reverse(ids.begin(), ids.end());
    for (auto row = ids.begin(); row != ids.end(); row += buffer.width) std::reverse(row, row + buffer.width);
  });
}

/// Writes the item ID file column by column.
StagedDevice withColumnsFirst() {
  return withReadBack([](const Face&, raster::ItemBuffer& buffer) {
    const std::vector<raster::ItemId> rows = buffer.ids;
    const auto width = static_cast<std::size_t>(buffer.width), height = static_cast<std::size_t>(buffer.height);
    for (std::size_t k = 0; k < rows.size(); ++k) buffer.ids[k] = rows[k % height * width + k / height];
  });
}

}  // namespace

std::vector<Fault> viewFaults(const TestVector& vector) {
  return {{"y of the view flipped",
           "row 0 is at y/w = -1, as in OpenGL and Vulkan and not in Direct3D: look at the sign of y in the projection",
           flippedViews([](Face& face) { face.y = -face.y; })},
          {"x of the view flipped", "column 0 is at x/w = -1: look at the handedness of the view's rows",
           flippedViews([](Face& face) { face.x = -face.x; })},
          {"picture upside down",
           "write row 0 of the framebuffer first: look at how rows are read back",
           {{"", withPicture(true)}}},
          {"picture mirrored",
           "write column 0 first in every row: look at how rows are read back",
           {{"", withPicture(false)}}},
          {"picture transposed",
           "write row by row: look at the order of rows and columns of the read-back",
           {{"", withColumnsFirst()}}},
          {"faces swapped", "draw each face with its own rows X, Y, W and write it into its own item ID file",
           reorderings(vector.faces)},
          {"faces turned", "use X as right and Y as the direction of rows for each face: every face has its own",
           turns(vector.faces)},
          {"viewport set to the scissor rectangle",
           "the viewport is resolution x resolution pixels: a side face keeps a part of it, not scaled",
           {{"", withScissorAsViewport()}}},
          {"viewport scaled by a pixel ratio",
           "the viewport is resolution x resolution pixels of the target: leave out the pixel ratio of the display",
           scaledViewports(raster::backgroundId(vector.list.format))},
          {"scissor rectangle read back from the wrong corner",
           "read from column and row of the scissor rectangle, not from (0, 0)",
           readBackFromFirst(raster::backgroundId(vector.list.format))},
          {"stale face", "wait for the device, and read each face before the next one is drawn",
           staleFaces(vector.faces.size())},
          {"enlarged picture",
           "draw item IDs with the resolution of the face: item IDs cannot be scaled",
           {enlarged(2), enlarged(4)}},
          {"dilation", "turn passes off that close gaps or outline objects",
           dilations(raster::backgroundId(vector.list.format))},
          {"projection moved within a pixel", "turn the jitter of temporal antialiasing off for item IDs", jitters()},
          {"picture moved by a pixel", "column 0 and row 0 come first: look at the corner of the viewport or copy",
           pixelShifts(raster::backgroundId(vector.list.format))},
          {"a face's own eye ignored",
           "use the eye of each face: look for an eye that is set once for all faces",
           {{"", withFirstEye()}}}};
}

}  // namespace hemitex::reference
