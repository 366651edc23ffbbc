#include "radiosity/pictures/id_pictures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/patch_view.h"
#include "raster/software/software_renderer.h"

namespace hemitex::radiosity {
namespace {

/// sRGB codes from 0 to 255, in which the sum of a level and a hue is exact.
using Codes = glm::ivec3;

constexpr Codes black(0), white(255), grey(160), magenta(255, 0, 255);

/// From 15 to 127: a ramp of 48 codes over the map, plus 64 codes on every other square of a chessboard. So adjacent
/// texels differ by at least 31 codes. Black without a map.
Codes texelLevel(int columns, int rows, int texel) {
  if (columns * rows == 1) return black;
  const int ramp = 48 * texel / (columns * rows - 1);
  const int chessboard = (texel % columns + texel / columns) % 2;
  return Codes(15 + ramp + 64 * chessboard);
}

/// From 0 to 128. Steps of the golden ratio around the circle of hues keep consecutive surfaces far apart. In units of
/// 2^-32 of the circle they are sums modulo 2^32.
Codes surfaceHue(std::uint32_t surface) {
  const double sixths = 6 * (static_cast<std::uint32_t>(surface * 2654435769u) / 4294967296.0);
  const auto level = [](double value) { return static_cast<int>(128 * std::clamp(value, 0.0, 1.0)); };
  return {level(std::fabs(sixths - 3) - 1), level(2 - std::fabs(sixths - 2)), level(2 - std::fabs(sixths - 4))};
}

/// From 15 to 127, in steps of the golden ratio, because elements of any shape have no chessboard.
Codes elementLevel(std::uint32_t number) {
  return Codes(15 + static_cast<int>(static_cast<std::uint32_t>(number * 2654435769u) / 4294967296.0 * 113));
}

Codes indexLevel(const IdLayout& layout, const PageIndex& place) {
  const Page& page = layout.pages[place.page];
  if (layout.indexMaps != IndexMaps::Unique) return texelLevel(page.columns, page.rows, static_cast<int>(place.index));
  return page.columns == 1 ? black : elementLevel(place.index);
}

/// The colour of an item ID that draws can produce.
using CodesOf = std::function<Codes(const PageIndex&)>;

Codes idCodes(const IdLayout& layout, raster::ItemId id, const CodesOf& codesOf) {
  if (id == raster::backId(layout.format)) return white;
  const std::optional<PageIndex> place = pageIndexOf(layout, id);
  return place ? codesOf(*place) : black;
}

CodesOf sumOfBoth(const IdLayout& layout) {
  return [&](const PageIndex& place) { return indexLevel(layout, place) + surfaceHue(place.page); };
}

/// Draws a list from a camera, with one sample per pixel.
raster::ItemBuffer drawBuffer(raster::DrawList list, const Scene& scene, const Camera& camera, int width, int height) {
  const raster::Face face = cameraFace(scene, camera, width, height);
  raster::SoftwareRenderer renderer(std::move(list));
  return render(renderer, {&face, 1}, trianglesFacingAway(scene, camera.eye)).front();
}

/// The picture of codesAt(column, row), with rows that go upwards.
template <typename CodesAt>
Image pictureOf(int width, int height, const CodesAt& codesAt) {
  Image image{width, height, {}};
  image.pixels.reserve(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int row = height - 1; row >= 0; --row)
    for (int column = 0; column < width; ++column)
      image.pixels.push_back(decodeSrgb(glm::dvec3(codesAt(column, row)) / 255.0));
  return image;
}

raster::ItemId idAt(const raster::ItemBuffer& buffer, int column, int row) {
  return buffer
      .ids[static_cast<std::size_t>(row) * static_cast<std::size_t>(buffer.width) + static_cast<std::size_t>(column)];
}

/// Draws the hemicube's draw list from a camera.
Image drawIds(const Scene& scene, const Discretization& discretization, const IdLayout& layout, const Camera& camera,
              int width, int height, const CodesOf& codesOf) {
  const raster::ItemBuffer buffer =
      drawBuffer(makeDrawList(scene, discretization, layout), scene, camera, width, height);
  return pictureOf(width, height,
                   [&](int column, int row) { return idCodes(layout, idAt(buffer, column, row), codesOf); });
}

/// The item ID of a face in a direction in front of it.
raster::ItemId idTowards(const raster::Face& face, const raster::ItemBuffer& buffer, const glm::dvec3& direction) {
  const double depth = glm::dot(glm::dvec3(face.w), direction);
  const auto place = [&](const glm::vec3& axis, int first, int size) {
    const double coordinate = glm::dot(glm::dvec3(axis), direction) / depth;
    const int pixel = static_cast<int>(std::floor((coordinate + 1) / 2 * face.resolution));
    return std::clamp(pixel - first, 0, size - 1);
  };
  return idAt(buffer, place(face.x, face.scissor.column, face.scissor.width),
              place(face.y, face.scissor.row, face.scissor.height));
}

/// The direction of a point of the unfolded hemicube, in the top face's x, y, w. The middle square [-1,1]^2 is the top
/// face. Beyond an edge of it, depth falls from 1 to 0 on the side below that edge.
glm::dvec3 unfoldedDirection(double x, double y) {
  const double overhang = std::max({std::fabs(x) - 1, std::fabs(y) - 1, 0.0});
  return {std::clamp(x, -1.0, 1.0), std::clamp(y, -1.0, 1.0), 1 - overhang};
}

}  // namespace

Image indexMapPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                      const Camera& camera, int width, int height) {
  return drawIds(scene, discretization, layout, camera, width, height,
                 [&](const PageIndex& place) { return indexLevel(layout, place); });
}

Image offsetPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                    const Camera& camera, int width, int height) {
  return drawIds(scene, discretization, layout, camera, width, height,
                 [](const PageIndex& place) { return surfaceHue(place.page); });
}

Image idPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout, const Camera& camera,
                int width, int height) {
  return drawIds(scene, discretization, layout, camera, width, height, sumOfBoth(layout));
}

BlendErrors blendErrorPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                              const Camera& camera, int width, int height) {
  raster::DrawList list = makeDrawList(scene, discretization, layout);
  const raster::ItemBuffer drawn = drawBuffer(list, scene, camera, width, height);
  if (list.blend == raster::Blend::ClampedAdd) list.blend = raster::Blend::IntegerAdd;
  const raster::ItemBuffer meant = drawBuffer(std::move(list), scene, camera, width, height);
  const CodesOf levelOf = [&](const PageIndex& place) { return indexLevel(layout, place); };
  BlendErrors errors;
  errors.picture = pictureOf(width, height, [&](int column, int row) {
    const raster::ItemId id = idAt(drawn, column, row), other = idAt(meant, column, row);
    if (elementOf(discretization, layout, id) == elementOf(discretization, layout, other))
      return idCodes(layout, id, levelOf);
    ++errors.pixels;
    return magenta;
  });
  return errors;
}

Image indexMapImage(int columns, int rows, int texelSide) {
  return pictureOf(columns * texelSide, rows * texelSide,
                   [&](int x, int y) { return texelLevel(columns, rows, y / texelSide * columns + x / texelSide); });
}

Image hemicubePicture(const IdLayout& layout, std::span<const raster::Face> faces,
                      std::span<const raster::ItemBuffer> buffers) {
  assert(!faces.empty() && faces.size() == buffers.size());
  const raster::Face& top = faces.front();
  // A viewer along the normal with `up` upwards has normal x up on the right; for some faces that is -x.
  const glm::dvec3 right = glm::dvec3(top.x) * (raster::determinant(top) < 0 ? 1.0 : -1.0);
  const glm::dvec3 up(top.y), normal(top.w);
  const int side = 2 * top.resolution;
  const CodesOf codesOf = sumOfBoth(layout);
  return pictureOf(side, side, [&](int column, int row) {
    const double x = (2.0 * column + 1 - side) / top.resolution, y = (2.0 * row + 1 - side) / top.resolution;
    if (std::min(std::fabs(x), std::fabs(y)) > 1) return grey;
    const glm::dvec3 local = unfoldedDirection(x, y);
    const glm::dvec3 direction = local.x * right + local.y * up + local.z * normal;
    const auto depth = [&](const raster::Face& face) { return glm::dot(glm::dvec3(face.w), direction); };
    const auto nearest =
        std::max_element(faces.begin(), faces.end(), [&](const auto& a, const auto& b) { return depth(a) < depth(b); });
    const raster::ItemBuffer& buffer = buffers[static_cast<std::size_t>(nearest - faces.begin())];
    return idCodes(layout, idTowards(*nearest, buffer, direction), codesOf);
  });
}

Image facesPicture(const IdLayout& layout, const Projection& projection, std::span<const raster::Face> faces,
                   std::span<const raster::ItemBuffer> buffers) {
  assert(!faces.empty() && faces.size() == buffers.size());
  const CodesOf codesOf = sumOfBoth(layout);
  const int width = buffers.front().width, height = buffers.front().height;
  return pictureOf(width * static_cast<int>(faces.size()), height, [&](int x, int row) {
    const auto face = static_cast<std::size_t>(x / width);
    assert(buffers[face].width == width && buffers[face].height == height);
    // A viewer along the face's w with y upwards has y x w on the right; for some faces that is -x.
    const int column = raster::determinant(faces[face]) < 0 ? x % width : width - 1 - x % width;
    const raster::Scissor& scissor = faces[face].scissor;
    const bool counts = shareOf(projection, face, scissor.column + column, scissor.row + row) > 0;
    return counts ? idCodes(layout, idAt(buffers[face], column, row), codesOf) : grey;
  });
}

}  // namespace hemitex::radiosity
