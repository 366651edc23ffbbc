#include <algorithm>
#include <cassert>
#include <cmath>

#include "radiosity/picture.h"
#include "raster/software_renderer.h"

namespace hemitex::radiosity {
namespace {

/// sRGB codes from 0 to 255, in which the sum of a level and a hue is exact.
using Codes = glm::ivec3;

constexpr Codes black(0), white(255), grey(160);

glm::dvec3 linear(const Codes& codes) {
  return {decodeSrgb(codes.x / 255.0), decodeSrgb(codes.y / 255.0), decodeSrgb(codes.z / 255.0)};
}

/// From 15 to 127: a ramp of 48 codes over the map, and 64 codes more on every other square of a chessboard, so that
/// texels that touch differ by 31 codes at the least. Black where there is no map.
Codes texelLevel(int columns, int rows, int texel) {
  if (columns * rows == 1) return black;
  const int ramp = 48 * texel / (columns * rows - 1);
  const int chessboard = (texel % columns + texel / columns) % 2;
  return Codes(15 + ramp + 64 * chessboard);
}

/// From 0 to 128. The golden ratio's steps around the circle of hues keep surfaces that follow each other far apart:
/// in units of 2^-32 of the circle they are sums modulo 2^32.
Codes surfaceHue(std::uint32_t surface) {
  const double sixths = 6 * (static_cast<std::uint32_t>(surface * 2654435769u) / 4294967296.0);
  const auto level = [](double value) { return static_cast<int>(128 * std::clamp(value, 0.0, 1.0)); };
  return {level(std::fabs(sixths - 3) - 1), level(2 - std::fabs(sixths - 2)), level(2 - std::fabs(sixths - 4))};
}

Codes texelLevel(const Discretization& discretization, const SurfaceTexel& place) {
  const Grid& grid = discretization.grids[place.surface];
  return texelLevel(grid.columns, grid.rows, static_cast<int>(place.texel));
}

/// The colour of a word that stands for a texel.
using CodesOf = std::function<Codes(const SurfaceTexel&)>;

Codes wordCodes(const Discretization& discretization, const WordLayout& layout, raster::Word word,
                const CodesOf& codesOf) {
  if (word == raster::backWord(layout.format)) return white;
  const std::optional<SurfaceTexel> place = texelOf(discretization, layout, word);
  return place ? codesOf(*place) : black;
}

CodesOf sumOfBoth(const Discretization& discretization) {
  return [&](const SurfaceTexel& place) { return texelLevel(discretization, place) + surfaceHue(place.surface); };
}

/// Draws the hemicube's draw list from a camera, a sample a pixel.
Image drawWords(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                const Camera& camera, int width, int height, const CodesOf& codesOf) {
  const raster::Face face = cameraFace(scene, camera, width, height);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  const raster::ItemBuffer buffer = renderer.render({&face, 1}, trianglesFacingAway(scene, camera.eye)).front();
  Image image{width, height, {}};
  image.pixels.reserve(buffer.words.size());
  for (int row = height - 1; row >= 0; --row)
    for (int column = 0; column < width; ++column) {
      const auto pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
      image.pixels.push_back(linear(wordCodes(discretization, layout, buffer.words[pixel], codesOf)));
    }
  return image;
}

/// The pixel of a face that shows a direction in front of it.
std::size_t pixelTowards(const raster::Face& face, const glm::dvec3& direction) {
  const double depth = glm::dot(glm::dvec3(face.w), direction);
  const auto place = [&](const glm::vec3& axis, int first, int size) {
    const double coordinate = glm::dot(glm::dvec3(axis), direction) / depth;
    const int pixel = static_cast<int>(std::floor((coordinate + 1) / 2 * face.resolution));
    return static_cast<std::size_t>(std::clamp(pixel - first, 0, size - 1));
  };
  return place(face.y, face.scissor.row, face.scissor.height) * static_cast<std::size_t>(face.scissor.width) +
         place(face.x, face.scissor.column, face.scissor.width);
}

/// The direction that a point of the unfolded hemicube stands for, in the top face's x, y, w: the middle square
/// [-1,1]^2 is the top face, and beyond an edge of it depth falls from 1 to 0 on the side below that edge.
glm::dvec3 unfoldedDirection(double x, double y) {
  const double overhang = std::max({std::fabs(x) - 1, std::fabs(y) - 1, 0.0});
  return {std::clamp(x, -1.0, 1.0), std::clamp(y, -1.0, 1.0), 1 - overhang};
}

}  // namespace

Image indexMapPicture(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                      const Camera& camera, int width, int height) {
  return drawWords(scene, discretization, layout, camera, width, height,
                   [&](const SurfaceTexel& place) { return texelLevel(discretization, place); });
}

Image offsetPicture(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                    const Camera& camera, int width, int height) {
  return drawWords(scene, discretization, layout, camera, width, height,
                   [](const SurfaceTexel& place) { return surfaceHue(place.surface); });
}

Image wordPicture(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                  const Camera& camera, int width, int height) {
  return drawWords(scene, discretization, layout, camera, width, height, sumOfBoth(discretization));
}

Image indexMapImage(int columns, int rows, int texelSide) {
  Image image{columns * texelSide, rows * texelSide, {}};
  for (int y = image.height - 1; y >= 0; --y)
    for (int x = 0; x < image.width; ++x)
      image.pixels.push_back(linear(texelLevel(columns, rows, y / texelSide * columns + x / texelSide)));
  return image;
}

Image hemicubePicture(const Discretization& discretization, const WordLayout& layout,
                      std::span<const raster::Face> faces, std::span<const raster::ItemBuffer> buffers) {
  assert(!faces.empty() && faces.size() == buffers.size());
  const raster::Face& top = faces.front();
  // Whoever looks along the normal with `up` upwards has normal x up on the right; of some faces that is -x.
  const glm::dvec3 right = glm::dvec3(top.x) * (raster::determinant(top) < 0 ? 1.0 : -1.0);
  const glm::dvec3 up(top.y), normal(top.w);
  const int side = 2 * top.resolution;
  const CodesOf codesOf = sumOfBoth(discretization);
  Image image{side, side, {}};
  for (int row = side - 1; row >= 0; --row)
    for (int column = 0; column < side; ++column) {
      const double x = (2.0 * column + 1 - side) / top.resolution, y = (2.0 * row + 1 - side) / top.resolution;
      if (std::min(std::fabs(x), std::fabs(y)) > 1) {
        image.pixels.push_back(linear(grey));
        continue;
      }
      const glm::dvec3 local = unfoldedDirection(x, y);
      const glm::dvec3 direction = local.x * right + local.y * up + local.z * normal;
      const auto depth = [&](const raster::Face& face) { return glm::dot(glm::dvec3(face.w), direction); };
      const auto nearest = std::max_element(faces.begin(), faces.end(),
                                            [&](const auto& a, const auto& b) { return depth(a) < depth(b); });
      const raster::ItemBuffer& buffer = buffers[static_cast<std::size_t>(nearest - faces.begin())];
      const raster::Word word = buffer.words[pixelTowards(*nearest, direction)];
      image.pixels.push_back(linear(wordCodes(discretization, layout, word, codesOf)));
    }
  return image;
}

}  // namespace hemitex::radiosity
