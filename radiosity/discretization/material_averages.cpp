#include "radiosity/discretization/material_averages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "radiosity/geometry/grid_clipping.h"

namespace hemitex::radiosity {
namespace {

/// Maximum number of pixels that are clipped for one surface.
constexpr double maxPixels = 0x1p24;

/// The texture coordinates of a triangle, moved by whole tiles, so that no digits are lost far from zero.
std::array<glm::dvec2, 3> nearTexcoords(const Triangle& triangle) {
  const glm::dvec2 tile = glm::floor(triangle.texcoord[0]);
  return {triangle.texcoord[0] - tile, triangle.texcoord[1] - tile, triangle.texcoord[2] - tile};
}

/// Estimate of the number of pixels to clip: those in the bounds of the triangles and those at their border.
double pixelsShown(const Image& image, const Surface& surface) {
  const glm::dvec2 size(image.width, image.height);
  double pixels = 0;
  for (const Triangle& triangle : surface.triangles) {
    const std::array<glm::dvec2, 3> t = nearTexcoords(triangle);
    const glm::dvec2 span = (glm::max(glm::max(t[0], t[1]), t[2]) - glm::min(glm::min(t[0], t[1]), t[2])) * size;
    pixels += span.x * span.y + span.x + span.y;
  }
  return pixels;
}

bool isOnePixel(const Image& image) { return image.width == 1 && image.height == 1; }

/// The image, halved until the surface shows few enough pixels; nothing if it shows few enough already.
std::optional<Image> reducedFor(const Surface& surface, const Image& image) {
  std::optional<Image> reduced;
  const auto last = [&]() -> const Image& { return reduced ? *reduced : image; };
  while (!isOnePixel(last()) && pixelsShown(last(), surface) > maxPixels) reduced = halved(last());
  return reduced;
}

/// The pixel at a cell of the repeated image; rows count from v = 0, the bottom of the picture.
const glm::dvec3& wrappedPixel(const Image& image, std::int64_t column, std::int64_t row) {
  const std::int64_t i = (column % image.width + image.width) % image.width;
  const std::int64_t j = (row % image.height + image.height) % image.height;
  return image.pixels[static_cast<std::size_t>((image.height - 1 - j) * image.width + i)];
}

/// The mean of the image over a piece of a triangle, which is cut into triangles and these into pixels.
glm::dvec3 meanOver(const Piece& piece, const std::array<glm::dvec2, 3>& texcoord, const Image& image) {
  const glm::dvec2 size(image.width, image.height);
  const auto inPixels = [&](const PieceCorner& corner) {
    return size * (texcoord[0] + corner.weight.x * (texcoord[1] - texcoord[0]) +
                   corner.weight.y * (texcoord[2] - texcoord[0]));
  };
  glm::dvec3 sum(0);
  double weight = 0;
  for (std::size_t i = 2; i < piece.size; ++i) {
    Piece part;
    part.corners = {piece.corners[0], piece.corners[i - 1], piece.corners[i]};
    part.size = 3;
    const double partShare = share(part);
    forEachCell({inPixels(part.corners[0]), inPixels(part.corners[1]), inPixels(part.corners[2])},
                [&](std::int64_t column, std::int64_t row, const Piece& inPixel) {
                  const double pixelShare = partShare * share(inPixel);
                  sum += pixelShare * wrappedPixel(image, column, row);
                  weight += pixelShare;
                });
  }
  return weight > 0 ? sum / weight : sum;
}

}  // namespace

std::vector<glm::dvec3> averageOverElements(const Image& image, const Surface& surface, const Grid& grid) {
  const std::optional<Image> reduced = reducedFor(surface, image);
  const Image& sized = reduced ? *reduced : image;
  std::vector<glm::dvec3> sum(grid.elementCount);
  std::vector<double> weight(grid.elementCount);
  forEachExposedPiece(surface, texelGrid(grid), [&](std::size_t texel, std::uint32_t t, const Piece& piece) {
    const Triangle& triangle = surface.triangles[t];
    const std::size_t element = grid.elementOfTexel[texel] - grid.firstElement;
    const double pieceArea = share(piece) * area(triangle);
    const glm::dvec3 mean = isOnePixel(sized) ? sized.pixels[0] : meanOver(piece, nearTexcoords(triangle), sized);
    sum[element] += pieceArea * mean;
    weight[element] += pieceArea;
  });
  for (std::size_t element = 0; element < sum.size(); ++element) sum[element] /= weight[element];
  return sum;
}

Image halved(const Image& image) {
  // Along one axis of n pixels, pixel i of the m = ceil(n/2) new ones covers [i, i+1] * n/m: two old pixels or parts of
  // three. In units of 1/m old pixels all borders are integers, so that the weights are exact.
  Image half{(image.width + 1) / 2, (image.height + 1) / 2, {}};
  const auto overlap = [](int i, int n, int m, int old) {
    return std::max(0, std::min((i + 1) * n, (old + 1) * m) - std::max(i * n, old * m));
  };
  half.pixels.reserve(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  for (int row = 0; row < half.height; ++row)
    for (int column = 0; column < half.width; ++column) {
      glm::dvec3 sum(0);
      for (int j = row * image.height / half.height; j * half.height < (row + 1) * image.height; ++j)
        for (int i = column * image.width / half.width; i * half.width < (column + 1) * image.width; ++i) {
          const double weight = static_cast<double>(overlap(row, image.height, half.height, j)) *
                                static_cast<double>(overlap(column, image.width, half.width, i));
          sum += weight * image.pixels[static_cast<std::size_t>(j * image.width + i)];
        }
      half.pixels.push_back(sum / (static_cast<double>(image.width) * static_cast<double>(image.height)));
    }
  return half;
}

std::vector<glm::dvec3> meansOfMap(const Scene& scene, const Surface& surface, const Grid& grid,
                                   const std::optional<int>& map) {
  if (!map) return std::vector<glm::dvec3>(grid.elementCount, glm::dvec3(1));
  return averageOverElements(scene.images[static_cast<std::size_t>(*map)], surface, grid);
}

}  // namespace hemitex::radiosity
