#include "radiosity/images/hole_colours.h"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "radiosity/geometry/distance_transform.h"

namespace hemitex::radiosity {
namespace {

/// Whether a pixel of an image of width x height pixels shows a part of the cut-out that is no hole.
bool isShown(const CutOut& cutOut, int width, int height, int column, int row) {
  const auto begin = [](std::int64_t cell, int from, int to) { return static_cast<int>(cell * to / from); };
  const auto end = [](std::int64_t cell, int from, int to) {
    return static_cast<int>(((cell + 1) * to + from - 1) / from);
  };
  for (int y = begin(row, height, cutOut.height); y < end(row, height, cutOut.height); ++y)
    for (int x = begin(column, width, cutOut.width); x < end(column, width, cutOut.width); ++x)
      if (!cutOut.isHole[static_cast<std::size_t>(y) * static_cast<std::size_t>(cutOut.width) +
                         static_cast<std::size_t>(x)])
        return true;
  return false;
}

/// Calls copy(to, from) for each pixel that is a hole with the nearest one that is none.
template <typename AnyImage, typename Copy>
void fill(const AnyImage& image, const CutOut& cutOut, const Copy& copy) {
  if (image.sampler != cutOut.sampler || std::max(image.width, image.height) > longestGridSide) return;
  std::vector<bool> shown;
  for (int row = 0; row < image.height; ++row)
    for (int column = 0; column < image.width; ++column)
      shown.push_back(isShown(cutOut, image.width, image.height, column, row));
  if (std::find(shown.begin(), shown.end(), true) == shown.end()) return;
  const std::vector<std::uint32_t> nearest = nearestCovered(image.width, image.height, shown);
  for (std::size_t pixel = 0; pixel < nearest.size(); ++pixel)
    if (!shown[pixel]) copy(pixel, std::size_t{nearest[pixel]});
}

}  // namespace

void fillHoles(Image& image, const CutOut& cutOut) {
  fill(image, cutOut, [&](std::size_t to, std::size_t from) { image.pixels[to] = image.pixels[from]; });
}

void fillHoles(CodedImage& image, const CutOut& cutOut) {
  fill(image, cutOut,
       [&](std::size_t to, std::size_t from) { std::copy_n(&image.codes[3 * from], 3, &image.codes[3 * to]); });
}

}  // namespace hemitex::radiosity
