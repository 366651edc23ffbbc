#include "radiosity/discretization/material_averages.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include "radiosity/cut_outs/chart_map.h"
#include "radiosity/geometry/grid_clipping.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

/// Maximum number of pixels that are clipped for one surface.
constexpr double maxPixels = 0x1p24;

/// By how much places along an axis may move without showing other pixels, so that no digits are lost far from zero.
double shiftOf(double a, double b, double c, Wrap wrap) {
  const auto [low, high] = std::minmax({a, b, c});
  if (wrap == Wrap::Repeat) return std::floor(a);
  if (wrap == Wrap::Mirror) return 2 * std::floor(a / 2);
  return low > 1 ? std::floor(low) - 1 : high < 0 ? std::ceil(high) : 0;
}

/// The places of the corners of a triangle in an image, near zero.
std::array<glm::dvec2, 3> placesIn(const Image& image, const Triangle& triangle) {
  std::array<glm::dvec2, 3> places;
  for (std::size_t k = 0; k < 3; ++k) places[k] = image.sampler(triangle.texcoord[k]);
  glm::dvec2 shift;
  for (int axis = 0; axis < 2; ++axis)
    shift[axis] =
        shiftOf(places[0][axis], places[1][axis], places[2][axis], image.sampler.wrap[static_cast<std::size_t>(axis)]);
  for (glm::dvec2& place : places) place -= shift;
  return places;
}

/// Estimate of the number of pixels to clip: those in the bounds of the triangles and those at their border.
double pixelsShown(const Image& image, const Surface& surface) {
  const glm::dvec2 size(image.width, image.height);
  double pixels = 0;
  for (const Triangle& triangle : surface.triangles) {
    const std::array<glm::dvec2, 3> t = placesIn(image, triangle);
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

using CornerColours = std::array<glm::dvec3, 3>;

glm::dvec3 colourAt(const CornerColours& colours, const glm::dvec2& weight) {
  return colours[0] + weight.x * (colours[1] - colours[0]) + weight.y * (colours[2] - colours[0]);
}

/// The mean of the image times the colours of the corners over a piece of a triangle, which is cut into triangles and
/// these into pixels. The mean of a colour over a pixel is the colour at the middle.
glm::dvec3 meanOver(const Piece& piece, const Triangle& triangle, const CornerColours& colours, const Image& image) {
  const glm::dvec2 size(image.width, image.height);
  const std::array<glm::dvec2, 3> places = placesIn(image, triangle);
  const auto inPixels = [&](const PieceCorner& corner) {
    return size * (places[0] + corner.weight.x * (places[1] - places[0]) + corner.weight.y * (places[2] - places[0]));
  };
  glm::dvec3 sum(0);
  double weight = 0;
  for (std::size_t i = 2; i < piece.size; ++i) {
    Piece part;
    part.corners = {piece.corners[0], piece.corners[i - 1], piece.corners[i]};
    part.size = 3;
    const double partShare = share(part);
    CornerColours ofPart;
    for (std::size_t k = 0; k < 3; ++k) ofPart[k] = colourAt(colours, part.corners[k].weight);
    forEachCell({inPixels(part.corners[0]), inPixels(part.corners[1]), inPixels(part.corners[2])},
                [&](std::int64_t column, std::int64_t row, const Piece& inPixel) {
                  const double pixelShare = partShare * share(inPixel);
                  const glm::dvec3& pixel =
                      image.pixels[wrappedPixel(image.width, image.height, image.sampler.wrap, column, row)];
                  sum += pixelShare * (pixel * colourAt(ofPart, centroid(inPixel)));
                  weight += pixelShare;
                });
  }
  return weight > 0 ? sum / weight : sum;
}

/// The image of a map; null without one.
const Image* imageOf(const Scene& scene, const Surface& surface, std::optional<int> Material::*map) {
  const std::optional<int>& number = scene.materials[static_cast<std::size_t>(surface.material)].*map;
  return number ? &scene.images[static_cast<std::size_t>(*number)] : nullptr;
}

/// A card: a square with an image, in whose place a surface has the same means.
struct Card {
  Surface square;
  std::array<glm::dvec2, 4> texcoords;
};

std::optional<Card> cardOf(const Surface& surface, const Grid& grid, const Image& image) {
  if (surface.hasColours || !grid.cutTexels.empty() || !isWholeParallelogram(surface)) return std::nullopt;
  const auto texcoord = textureMap(surface, image.sampler, {image.width, image.height});
  if (!texcoord) return std::nullopt;
  constexpr std::array<glm::dvec2, 4> corners{glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)};
  Card card;
  for (std::size_t k = 0; k < 4; ++k) card.texcoords[k] = (*texcoord)(corners[k]);
  constexpr std::array<std::array<std::size_t, 3>, 2> halves{{{0, 1, 2}, {0, 2, 3}}};
  for (const std::array<std::size_t, 3>& triangle : halves) {
    Triangle& half = card.square.triangles.emplace_back();
    for (std::size_t k = 0; k < 3; ++k) {
      half.chart[k] = corners[triangle[k]];
      half.texcoord[k] = card.texcoords[triangle[k]];
      half.position[k] = {half.chart[k], 0};
    }
  }
  return card;
}

/// What the integrals over a card depend on.
auto keyOf(const Card& card, const Grid& grid, const Image& image) {
  std::vector<double> places;
  for (const glm::dvec2& texcoord : card.texcoords) places.insert(places.end(), {texcoord.x, texcoord.y});
  return std::tuple{&image, grid.columns, grid.rows, texelGrid(grid).mask, std::move(places)};
}

/// The integral of an image over each texel of a grid, and the area there.
struct Integrals {
  std::vector<glm::dvec3> sum;
  std::vector<double> weight;
};

/// Over one surface; of the colours of corners alone without an image, and empty without both.
Integrals integralsOver(const Surface& surface, const Grid& grid, const Image* image, bool isColoured) {
  if (!image && !isColoured) return {};
  const Image white{1, 1, {glm::dvec3(1)}}, &whole = image ? *image : white;
  const std::optional<Image> reduced = reducedFor(surface, whole);
  const Image& sized = reduced ? *reduced : whole;
  Integrals integrals{std::vector<glm::dvec3>(grid.elementOfTexel.size()),
                      std::vector<double>(grid.elementOfTexel.size())};
  forEachExposedPiece(surface, texelGrid(grid), [&](std::size_t texel, std::uint32_t t, const Piece& piece) {
    const Triangle& triangle = surface.triangles[t];
    const double pieceArea = share(piece) * area(triangle);
    CornerColours colours;
    for (std::size_t k = 0; k < 3; ++k) colours[k] = isColoured ? glm::dvec3(triangle.colour[k]) : glm::dvec3(1);
    const glm::dvec3 mean = isOnePixel(sized) ? sized.pixels[0] * colourAt(colours, centroid(piece))
                                              : meanOver(piece, triangle, colours, sized);
    integrals.sum[texel] += pieceArea * mean;
    integrals.weight[texel] += pieceArea;
  });
  return integrals;
}

std::vector<glm::dvec3> meansOf(const Integrals& integrals, const Grid& grid) {
  if (integrals.sum.empty()) return std::vector<glm::dvec3>(grid.elementCount, glm::dvec3(1));
  std::vector<glm::dvec3> sum(grid.elementCount);
  std::vector<double> weight(grid.elementCount);
  for (std::size_t texel = 0; texel < integrals.sum.size(); ++texel) {
    const std::size_t element = grid.elementOfTexel[texel] - grid.firstElement;
    sum[element] += integrals.sum[texel];
    weight[element] += integrals.weight[texel];
  }
  for (std::size_t element = 0; element < sum.size(); ++element)
    if (weight[element] > 0) sum[element] /= weight[element];
  return sum;
}

}  // namespace

std::vector<std::vector<glm::dvec3>> meansOfMap(const Scene& scene, std::span<const Grid> grids,
                                                std::optional<int> Material::*map) {
  std::vector<Integrals> integrals(scene.surfaces.size());
  std::vector<std::optional<Card>> cards(integrals.size());
  std::map<decltype(keyOf(*cards[0], grids[0], scene.images[0])), std::size_t> first;
  std::vector<std::size_t> sameAs;  // the surface that has the integrals, of each
  for (std::size_t s = 0; s < integrals.size(); ++s) {
    const Image* const image = imageOf(scene, scene.surfaces[s], map);
    if (image) cards[s] = cardOf(scene.surfaces[s], grids[s], *image);
    sameAs.push_back(cards[s] ? first.try_emplace(keyOf(*cards[s], grids[s], *image), s).first->second : s);
  }
  raster::parallelFor(integrals.size(), [&](std::size_t s) {
    const Surface& surface = scene.surfaces[s];
    if (sameAs[s] == s)
      integrals[s] = integralsOver(cards[s] ? cards[s]->square : surface, grids[s], imageOf(scene, surface, map),
                                   map == &Material::reflectanceMap && surface.hasColours);
  });
  std::vector<std::vector<glm::dvec3>> means;
  for (std::size_t s = 0; s < integrals.size(); ++s) means.push_back(meansOf(integrals[sameAs[s]], grids[s]));
  return means;
}

Image halved(const Image& image) {
  // Along one axis of n pixels, pixel i of the m = ceil(n/2) new ones covers [i, i+1] * n/m: two old pixels or parts of
  // three. In units of 1/m old pixels all borders are integers, so that the weights are exact.
  Image half{(image.width + 1) / 2, (image.height + 1) / 2, {}, image.sampler};
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

}  // namespace hemitex::radiosity
