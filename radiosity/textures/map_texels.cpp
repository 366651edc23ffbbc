#include "radiosity/textures/map_texels.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <optional>

#include "radiosity/discretization/material_averages.h"
#include "radiosity/geometry/distance_transform.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

const Material& materialOf(const Scene& scene, const Surface& surface) {
  return scene.materials[static_cast<std::size_t>(surface.material)];
}

/// The lengths of the chart axes in an image, |dT/du| and |dT/dv|, the means over the chart.
glm::dvec2 lengthsIn(const Sampler& sampler, const Surface& surface) {
  glm::dvec2 sum(0);
  double total = 0;
  for (const Triangle& triangle : surface.triangles) {
    const glm::dvec2 origin = sampler(triangle.texcoord[0]), t1 = sampler(triangle.texcoord[1]) - origin,
                     t2 = sampler(triangle.texcoord[2]) - origin;
    const glm::dvec2 c1 = triangle.chart[1] - triangle.chart[0], c2 = triangle.chart[2] - triangle.chart[0];
    const double area = std::abs(c1.x * c2.y - c1.y * c2.x);
    sum += glm::dvec2(glm::length(c2.y * t1 - c1.y * t2), glm::length(c1.x * t2 - c2.x * t1));
    total += area;
  }
  return total > 0 ? sum / total : sum;
}

template <typename AnyImage>
glm::dvec2 pixelsOf(const Surface& surface, const AnyImage& image) {
  return lengthsIn(image.sampler, surface) * static_cast<double>(std::max(image.width, image.height));
}

/// Values of a triangle as an affine function of the place in texels.
template <typename Value>
struct Affine {
  Value atZero{0.0}, perColumn{0.0}, perRow{0.0};

  /// The function with `values` at the corner `a` and at those that lie `b` and `c` from it, which are not on one line.
  Affine(const std::array<Value, 3>& values, const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c)
      : atZero(values[0]) {
    const double determinant = b.x * c.y - b.y * c.x;
    if (determinant == 0) return;
    const Value v1 = values[1] - values[0], v2 = values[2] - values[0];
    perColumn = (c.y * v1 - b.y * v2) / determinant;
    perRow = (b.x * v2 - c.x * v1) / determinant;
    atZero -= a.x * perColumn + a.y * perRow;
  }
  Value at(double column, double row) const { return atZero + column * perColumn + row * perRow; }
};
using Texcoords = Affine<glm::dvec2>;

/// The number of the first triangle that covers the centre of each texel, and the functions of all triangles.
struct Covering {
  std::vector<std::optional<std::uint32_t>> triangle;  ///< columns * rows
  std::vector<Texcoords> texcoords;
  std::vector<Affine<glm::dvec3>> colours;  ///< empty without colours
};

Covering coveringTriangles(const Surface& surface, int columns, int rows) {
  Covering covering;
  covering.triangle.resize(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  const glm::dvec2 size(columns, rows);
  for (const Triangle& triangle : surface.triangles) {
    const auto number = static_cast<std::uint32_t>(covering.texcoords.size());
    const glm::dvec2 a = triangle.chart[0] * size, b = triangle.chart[1] * size - a, c = triangle.chart[2] * size - a;
    const double determinant = b.x * c.y - b.y * c.x;
    covering.texcoords.emplace_back(triangle.texcoord, a, b, c);
    if (surface.hasColours) {
      const auto& [first, second, third] = triangle.colour;
      covering.colours.emplace_back(std::array<glm::dvec3, 3>{first, second, third}, a, b, c);
    }
    if (determinant == 0) continue;
    const glm::dvec2 low = a + glm::min(glm::min(b, c), glm::dvec2(0)),
                     high = a + glm::max(glm::max(b, c), glm::dvec2(0));
    const auto first = [](double from) { return std::max(0, static_cast<int>(std::ceil(from - 0.5))); };
    const auto last = [](double to, int count) { return std::min(count - 1, static_cast<int>(std::floor(to - 0.5))); };
    for (int row = first(low.y); row <= last(high.y, rows); ++row)
      for (int column = first(low.x); column <= last(high.x, columns); ++column) {
        const glm::dvec2 p = glm::dvec2(column + 0.5, row + 0.5) - a;
        const double s = (p.x * c.y - p.y * c.x) / determinant, t = (b.x * p.y - b.y * p.x) / determinant;
        std::optional<std::uint32_t>& of =
            covering.triangle[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                              static_cast<std::size_t>(column)];
        if (s >= 0 && t >= 0 && s + t <= 1 && !of) of = number;
      }
  }
  return covering;
}

/// For each texel the nearest one that a triangle covers; nothing if there is none.
std::vector<std::uint32_t> nearestCoveredTexels(const Covering& covering, int columns, int rows) {
  std::vector<bool> covered;
  for (const auto& triangle : covering.triangle) covered.push_back(triangle.has_value());
  if (std::find(covered.begin(), covered.end(), true) == covered.end()) return {};
  return nearestCovered(columns, rows, covered);
}

/// The pixel of an image at a texture coordinate; v = 0 is the bottom.
const glm::dvec3& pixelAt(const Image& image, const glm::dvec2& texcoord) {
  const glm::dvec2 place = nearPlace(image.sampler(texcoord), image.sampler.wrap);
  const auto column = static_cast<std::int64_t>(place.x * image.width),
             row = static_cast<std::int64_t>(place.y * image.height);
  return image.pixels[wrappedPixel(image.width, image.height, image.sampler.wrap, column, row)];
}

/// A map and its factor; without a map the factor alone.
class MappedValue {
 public:
  /// `pixelsPerTexel` is the larger one of both axes.
  MappedValue(const glm::dvec3& factor, const ImageLevels* levels, double pixelsPerTexel) : factor_(factor) {
    if (levels == nullptr) return;
    std::size_t level = 0;
    for (; pixelsPerTexel >= 2 && level + 1 < levels->size(); pixelsPerTexel /= 2) ++level;
    image_ = &(*levels)[level];
  }
  /// The mean at 2 x 2 places of a texel.
  glm::dvec3 at(const Texcoords& texcoords, double column, double row) const {
    if (image_ == nullptr) return factor_;
    glm::dvec3 sum(0);
    for (const double y : {0.25, 0.75})
      for (const double x : {0.25, 0.75}) sum += pixelAt(*image_, texcoords.at(column + x, row + y));
    return factor_ * (sum / 4.0);
  }

 private:
  glm::dvec3 factor_;
  const Image* image_ = nullptr;
};

}  // namespace

glm::dvec2 mapPixels(const Scene& scene, const Surface& surface) {
  const Material& material = materialOf(scene, surface);
  glm::dvec2 pixels(0);
  for (const std::optional<int>& map : {material.reflectanceMap, material.emissionMap})
    if (map) pixels = glm::max(pixels, pixelsOf(surface, scene.images[static_cast<std::size_t>(*map)]));
  if (material.cutOut) pixels = glm::max(pixels, pixelsOf(surface, *material.cutOut));
  return pixels;
}

std::vector<ImageLevels> levelsOfMaps(const Scene& scene) {
  std::vector<ImageLevels> levels(scene.images.size());
  std::vector<bool> isShown(scene.images.size());
  for (const Surface& surface : scene.surfaces)
    for (const std::optional<int>& map :
         {materialOf(scene, surface).reflectanceMap, materialOf(scene, surface).emissionMap})
      if (map) isShown[static_cast<std::size_t>(*map)] = true;
  raster::parallelFor(levels.size(), [&](std::size_t i) {
    if (!isShown[i]) return;
    levels[i].push_back(scene.images[i]);
    while (levels[i].back().width > 1 || levels[i].back().height > 1) levels[i].push_back(halved(levels[i].back()));
  });
  return levels;
}

void applyMaps(const Scene& scene, const std::vector<ImageLevels>& levels, const Surface& surface, int columns,
               int rows, std::vector<glm::dvec3>& texels) {
  const Covering covering = coveringTriangles(surface, columns, rows);
  assert(texels.size() == covering.triangle.size());
  const std::vector<std::uint32_t> nearest = nearestCoveredTexels(covering, columns, rows);
  const Material& material = materialOf(scene, surface);
  const auto valueOf = [&](const glm::dvec3& factor, const std::optional<int>& map) {
    if (!map) return MappedValue(factor, nullptr, 0);
    const ImageLevels& ofMap = levels[static_cast<std::size_t>(*map)];
    const glm::dvec2 perTexel = pixelsOf(surface, ofMap.front()) / glm::dvec2(columns, rows);
    return MappedValue(factor, &ofMap, std::max(perTexel.x, perTexel.y));
  };
  const MappedValue reflectance = valueOf(material.reflectance, material.reflectanceMap),
                    emission = valueOf(material.emission, material.emissionMap);
  for (std::size_t i = 0; i < texels.size(); ++i) {
    const std::size_t texel = nearest.empty() ? i : nearest[i];
    const Texcoords& texcoords = covering.texcoords[covering.triangle[texel].value_or(0)];
    const auto column = static_cast<double>(texel % static_cast<std::size_t>(columns)),
               row = static_cast<double>(texel / static_cast<std::size_t>(columns));
    glm::dvec3 reflected = reflectance.at(texcoords, column, row) * texels[i];
    if (surface.hasColours) {
      const Affine<glm::dvec3>& colour = covering.colours[covering.triangle[texel].value_or(0)];
      reflected *= glm::clamp(colour.at(column + 0.5, row + 0.5), 0.0, 1.0);
    }
    texels[i] = emission.at(texcoords, column, row) + reflected;
  }
}

}  // namespace hemitex::radiosity
