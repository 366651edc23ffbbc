/// The texel of a sample, clamp(floor(u N), 0, N - 1): for u interpolated with perspective, and for u beside borders.
#include <cmath>

#include "reference/conformance/suite/vector_suite.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {
namespace {

/// Aligned above every index of the maps below, so that item IDs of u and of v differ.
constexpr raster::ItemId mark = 0x10000;

/// A picture with one textured draw.
Picture mapped(Picture picture, raster::IndexMap map) {
  picture.indexMaps.push_back(std::move(map));
  addDraw(picture, mark, {}, 0);
  return picture;
}

/// A floor from w = 1 to w = 40.
TestVector perspectiveFloor() {
  Picture picture = mapped(Picture(64), countingMap(64, 64));
  addQuad(picture, {glm::vec3(-3, 0.8f, 40), glm::vec3(3, 0.8f, 40), glm::vec3(3, 0.8f, 1), glm::vec3(-3, 0.8f, 1)});
  return makeVector("perspective-floor", "texture coordinates interpolated without perspective, w 40 : 1", picture);
}

/// A pair of triangles whose corners have different depths, up to 40 times the smallest.
TestVector perspectiveTwist() {
  Picture picture = mapped(Picture(64), countingMap(48, 80));
  addQuad(picture, {picture.point({3, 5}, 1), picture.point({61, 2}, 40), picture.point({58, 63}, 2.5),
                    picture.point({1, 55}, 11)});
  return makeVector("perspective-twist", "perspective by quad instead of by triangle, w 40 : 1", picture);
}

/// A wall beside the eye, cut at the near plane and at the guard band.
TestVector perspectiveClipped() {
  Picture picture = mapped(Picture(64, 0.25f), countingMap(100, 7));
  addQuad(picture,
          {glm::vec3(0.3f, -2, -3), glm::vec3(0.6f, -2, 20), glm::vec3(0.6f, 2.5f, 20), glm::vec3(0.3f, 2, -3)});
  return makeVector("perspective-clipped", "texture coordinates not clipped with the triangle, or clipped after 1/w",
                    picture);
}

/// Samples exactly on the borders of texels in both directions: u = column/32, v = row/32.
TestVector bordersOnSamples() {
  Picture picture = mapped(Picture(32), countingMap(32, 32));
  const float half = 0.5f / 32;
  picture.addBlock(picture.whole(), 1, {-half, -half}, {1 - half, 1 - half});
  return makeVector("borders-on-samples", "a sample on a texel's border that goes to the texel before it", picture);
}

/// Coordinates from -1 to 2, and, in the last rows, from minus to plus a million.
TestVector clampedCoordinates() {
  Picture picture = mapped(Picture(48), countingMap(5, 3));
  picture.addBlock({0, 0, 48, 46}, 1, {-1, -1}, {2, 2});
  picture.addBlock({0, 46, 48, 48}, 1, {-1e6f, -1e6f}, {1e6f, 1e6f});
  return makeVector("clamped-coordinates", "repeated or mirrored index maps, overflow of texel numbers", picture);
}

/// 7 x 3 texels of 6 x 14 pixels each.
TestVector rectangularMap() {
  Picture picture = mapped(Picture(42), countingMap(7, 3));
  picture.addBlock(picture.whole());
  return makeVector("rectangular-map", "width and height exchanged, rows upside down, rows padded to 4 or more words",
                    picture);
}

/// Texels of 8 x 8 pixels whose item IDs are far apart.
TestVector magnified() {
  raster::IndexMap map{4, 4, {}};
  for (raster::ItemId texel = 0; texel < 16; ++texel) map.ids.push_back((texel * 7 % 16) * 0x0fff);
  Picture picture = mapped(Picture(32), std::move(map));
  picture.addBlock(picture.whole());
  return makeVector("magnified", "linear filtering: words between those of neighbours", picture);
}

/// 120 x 120 texels on 16 x 16 pixels.
TestVector minified() {
  Picture picture = mapped(Picture(16), countingMap(120, 120));
  picture.addBlock(picture.whole());
  return makeVector("minified", "mipmapping, or a filter over the pixel's footprint", picture);
}

/// 8 x 8 quads of constant coordinates: in every other cell on the border of a texel, in the others a quarter of a
/// texel beyond it; u in the upper half, v in the lower half. Depths are powers of two and coordinates multiples of
/// 1/256, so that double precision interpolates without rounding.
TestVector constantCoordinates() {
  constexpr int resolution = 32, cell = 4;
  Picture picture(resolution);
  picture.indexMaps = {countingMap(64, 4), countingMap(4, 64)};
  for (int number = 0; number < 64; ++number) {
    const bool isU = number < 32;
    const bool isOnBorder = (number + number / 8) % 2 == 0;
    const float constant = static_cast<float>(4 * (2 * (number % 32) + 1) + (isOnBorder ? 0 : 1)) / 256;
    const glm::vec2 texcoord = isU ? glm::vec2(constant, 0.375f) : glm::vec2(0.375f, constant);
    addDraw(picture, isU ? 0 : mark, {}, isU ? 0 : 1);
    std::array<glm::vec3, 4> corners;
    for (int k = 0; k < 4; ++k) {
      const glm::dvec2 pixel(number % 8 * cell + (k == 1 || k == 2 ? cell : 0), number / 8 * cell + k / 2 * cell);
      corners[static_cast<std::size_t>(k)] = picture.point(pixel, std::ldexp(1.0, (k * (2 * number + 1) + number) % 4));
    }
    addQuad(picture, corners, texcoord, texcoord);
  }
  return makeVector("constant-coordinates", "a coordinate that is equal at all corners and interpolated to just below",
                    picture);
}

/// Lines of pixels that show every seventh texel of a map of 4000, a quarter of a texel or more away from borders: rows
/// along u in the upper half, columns along v in the lower half. From 1/2 on, a half float holds one number per two
/// texels.
TestVector fineCoordinates() {
  constexpr int side = 32, resolution = side + 2;  // inside of the view, where nothing is clipped
  constexpr int texels = 4000, step = 7;
  Picture picture(resolution);
  picture.indexMaps = {countingMap(texels, 1), countingMap(1, texels)};
  const auto addLine = [&](const Block& block, bool isU, int line, int lines) {
    const int pixels = isU ? block.endColumn - block.firstColumn : block.endRow - block.firstRow;
    const double start = 3 + texels / lines * line + 0.25 + line % 4 * 0.125 - 0.5 * step;
    const auto low = static_cast<float>(start / texels), high = static_cast<float>((start + step * pixels) / texels);
    const glm::vec2 first = isU ? glm::vec2(low, 0.5f) : glm::vec2(0.5f, low);
    picture.addBlock(block, 1, first, isU ? glm::vec2(high, 0.5f) : glm::vec2(0.5f, high));
  };
  addDraw(picture, 0, {}, 0);
  for (int row = 0; row < side / 2; ++row) addLine({1, 1 + row, 1 + side, 2 + row}, true, row, side / 2);
  addDraw(picture, mark, {}, 1);
  for (int column = 0; column < side; ++column)
    addLine({1 + column, 1 + side / 2, 2 + column, 1 + side}, false, column, side);
  return makeVector("fine-coordinates", "texture coordinates in half floats or in fixed point with too few bits",
                    picture);
}

/// Sixteen draws with a map each, all of different sizes; two draws share one.
TestVector manyMaps() {
  Picture picture(32);
  for (int k = 0; k < 16; ++k) {
    if (k < 15) picture.indexMaps.push_back(countingMap(1 + k, 1 + k * 5 % 7));
    addDraw(picture, static_cast<raster::ItemId>(k) << 16, {}, k * 11 % 15);
    const int column = k % 4 * 8, row = k / 4 * 8;
    picture.addBlock({column, row, column + 8, row + 8});
  }
  return makeVector("many-maps", "a draw that shows another draw's index map", picture);
}

}  // namespace

TestVector texelBorders(int texels) {
  std::vector<float> steps;
  for (int k = 0; k <= texels; ++k) {
    const float border = static_cast<float>(static_cast<double>(k) / texels);
    steps.insert(steps.end(), {std::nextafter(border, -1.0f), border, std::nextafter(border, 2.0f)});
  }
  const int pixels = 2 * static_cast<int>(steps.size());
  int resolution = 2;
  while (resolution * resolution < pixels) resolution += 2;

  Picture picture(resolution);
  picture.indexMaps = {countingMap(texels, 1), countingMap(1, texels)};
  int pixel = 0;
  for (const bool isU : {true, false}) {
    addDraw(picture, isU ? 0 : mark, {}, isU ? 0 : 1);
    for (const float step : steps) {
      const glm::vec2 texcoord = isU ? glm::vec2(step, 0.5f) : glm::vec2(0.5f, step);
      picture.addPixel(pixel % resolution, pixel / resolution, 1, texcoord);
      ++pixel;
    }
  }
  return makeVector("texels-" + std::to_string(texels),
                    "u N rounded before its floor is taken, and half-texel shifts, beside k/" + std::to_string(texels),
                    picture);
}

std::vector<TestVector> texelVectors() {
  std::vector<TestVector> vectors;
  for (const int texels : {1, 3, 7, 100, 255, 256, 257, 1000, 1024}) vectors.push_back(texelBorders(texels));
  for (const auto& make : {perspectiveFloor, perspectiveTwist, perspectiveClipped, bordersOnSamples, clampedCoordinates,
                           rectangularMap, magnified, minified, manyMaps, constantCoordinates, fineCoordinates})
    vectors.push_back(make());
  return vectors;
}

}  // namespace hemitex::reference
