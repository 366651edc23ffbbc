#include "radiosity/pictures/pictures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "radiosity/projection/patch_view.h"
#include "raster/base/input_error.h"
#include "raster/base/parallel.h"

namespace hemitex::radiosity {
namespace {

constexpr int largestPicture = 2048;

using SampleRow = std::vector<std::optional<Visible>>;

void requireSides(int width, int height) {
  if (std::max(width, height) > largestPicture)
    throw raster::InputError("a picture of " + std::to_string(width) + " x " + std::to_string(height) + " pixels",
                             "choose sides of at most " + std::to_string(largestPicture));
}

/// Averages 2 x 2 samples of a picture of twice the size into each pixel.
Image halved(const std::vector<glm::dvec3>& samples, int width, int height) {
  Image image{width, height, {}};
  image.pixels.reserve(samples.size() / 4);
  const auto at = [&](int column, int row) {
    return samples[static_cast<std::size_t>(row) * static_cast<std::size_t>(2 * width) +
                   static_cast<std::size_t>(column)];
  };
  for (int row = 0; row < 2 * height; row += 2)
    for (int column = 0; column < 2 * width; column += 2)
      image.pixels.push_back((at(column, row) + at(column + 1, row) + at(column, row + 1) + at(column + 1, row + 1)) /
                             4.0);
  return image;
}

/// The mean colour of the 2 x 2 samples of a pixel.
class MeanColour {
 public:
  MeanColour(const ColourOf& colourOf, const glm::dvec3& background) : colourOf_(colourOf), background_(background) {}

  glm::dvec3 operator()(const SampleRow& upper, const SampleRow& lower, int pixel) const {
    const auto left = 2 * static_cast<std::size_t>(pixel);
    return (of(upper[left]) + of(upper[left + 1]) + of(lower[left]) + of(lower[left + 1])) / 4.0;
  }

 private:
  glm::dvec3 of(const std::optional<Visible>& sample) const { return sample ? colourOf_(*sample) : background_; }

  const ColourOf& colourOf_;
  glm::dvec3 background_;
};

/// Whether an edge of the picture is between two samples: they show different surfaces, or triangles of one surface
/// whose normals differ by more than 5 degrees. Otherwise, too, if one point is farther from the plane of the other
/// than the side of a pixel there, as at the outline of a part in front of another.
class EdgeTest {
 public:
  EdgeTest(const Scene& scene, const Camera& camera, int height)
      : scene_(scene),
        eye_(camera.eye),
        forward_(axesOf(camera).forward),
        pixelSide_(2 * tangentOfDegrees(camera.fov / 2) / height) {}

  bool isBetween(const std::optional<Visible>& one, const std::optional<Visible>& other) const {
    if (!one || !other) return one.has_value() != other.has_value();
    if (one->surface != other->surface || one->instance != other->instance) return true;
    if (one->triangle == other->triangle) return false;
    const glm::dvec3 n = normalOf(*one), m = normalOf(*other);
    if (glm::dot(n, m) < minCosine) return true;
    const glm::dvec3 point = positionOf(scene_, *one), way = positionOf(scene_, *other) - point;
    const double side = pixelSide_ * glm::dot(point - eye_, forward_);
    return std::max(std::abs(glm::dot(n, way)), std::abs(glm::dot(m, way))) > side;
  }

 private:
  static constexpr double minCosine = 0.9962;  // of 5 degrees

  glm::dvec3 normalOf(const Visible& visible) const {
    const auto [a, b, c] = placedCorners(scene_, {visible.instance, visible.surface, visible.triangle});
    return glm::normalize(glm::cross(b - a, c - a));
  }

  const Scene& scene_;
  glm::dvec3 eye_, forward_;
  double pixelSide_;  ///< at distance 1
};

/// Whether an edge is between the samples of a pixel, or between these and those beside them, in four rows.
bool isAtEdge(const EdgeTest& test, std::span<const SampleRow, 4> rows, int pixel) {
  const int left = 2 * pixel, last = static_cast<int>(rows[1].size()) - 1;
  const auto& first = rows[1][static_cast<std::size_t>(left)];
  for (int k = 0; k < 16; ++k) {
    const int column = std::clamp(left - 1 + k % 4, 0, last);
    if (test.isBetween(first, rows[static_cast<std::size_t>(k / 4)][static_cast<std::size_t>(column)])) return true;
  }
  return false;
}

/// Calls body(row, edges of the row) for the rows of pixels in which edges mark any, at the same time.
void forEachRowWithEdges(const std::vector<std::uint8_t>& edges, int width,
                         const std::function<void(int row, std::span<const std::uint8_t>)>& body) {
  const auto columns = static_cast<std::size_t>(width);
  raster::parallelFor(edges.size() / columns, [&](std::size_t row) {
    const std::span ofRow = std::span(edges).subspan(row * columns, columns);
    if (std::find(ofRow.begin(), ofRow.end(), 1) != ofRow.end()) body(static_cast<int>(row), ofRow);
  });
}

const Triangle& triangleOf(const Scene& scene, const Visible& visible) {
  return scene.surfaces[visible.surface].triangles[visible.triangle];
}

template <typename Value>
Value interpolate(const std::array<Value, 3>& corners, const glm::dvec3& weights) {
  return weights.x * corners[0] + weights.y * corners[1] + weights.z * corners[2];
}

/// A line runs between two samples if these differ.
struct ShownPiece {
  std::uint32_t surface = 0, polygon = 0, element = 0;
  bool operator==(const ShownPiece&) const = default;
};

/// Black where one of a sample's four neighbours shows another piece, by pieceOf(sample): lines of two samples, which
/// is one pixel.
template <typename PieceOf>
Image borderPicture(const Scene& scene, const Camera& camera, int width, int height, const PieceOf& pieceOf) {
  requireSides(width, height);
  std::vector<std::optional<ShownPiece>> pieces;
  for (const std::optional<Visible>& visible : visibleSamples(scene, camera, 2 * width, 2 * height))
    pieces.push_back(visible ? std::optional<ShownPiece>(pieceOf(*visible)) : std::nullopt);
  const int columns = 2 * width, rows = 2 * height;
  const auto at = [&](int column, int row) -> const std::optional<ShownPiece>& {
    const int c = std::clamp(column, 0, columns - 1), r = std::clamp(row, 0, rows - 1);
    return pieces[static_cast<std::size_t>(r) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(c)];
  };
  std::vector<glm::dvec3> samples;
  samples.reserve(pieces.size());
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      const std::optional<ShownPiece>& piece = at(column, row);
      const bool isBorder = at(column - 1, row) != piece || at(column + 1, row) != piece ||
                            at(column, row - 1) != piece || at(column, row + 1) != piece;
      samples.emplace_back(isBorder ? 0.0 : 1.0);
    }
  return halved(samples, width, height);
}

}  // namespace

std::uint32_t elementAt(const Scene& scene, const Discretization& discretization, const Visible& visible) {
  const Grid& grid = discretization.grids[visible.surface];
  const glm::dvec2 chart = interpolate(triangleOf(scene, visible).chart, visible.weights);
  const int column = std::clamp(static_cast<int>(chart.x * grid.columns), 0, grid.columns - 1);
  const int row = std::clamp(static_cast<int>(chart.y * grid.rows), 0, grid.rows - 1);
  return grid.elementOfTexel[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) +
                             static_cast<std::size_t>(column)];
}

Image drawPicture(const Scene& scene, const Camera& camera, int width, int height, const ColourOf& colourOf,
                  const glm::dvec3& background) {
  requireSides(width, height);
  constexpr int rowsOfTask = 16;
  const std::vector<std::uint32_t> skipped = trianglesFacingAway(scene, camera.eye);
  const EdgeTest test(scene, camera, height);
  const MeanColour meanColour(colourOf, background);
  TriangleView view(scene);
  const TriangleSamples samples = view.see(camera, 2 * width, 2 * height, skipped);
  const auto pixels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  const auto at = [&](int column, int row) {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) + static_cast<std::size_t>(column);
  };
  Image image{width, height, std::vector<glm::dvec3>(pixels)};
  std::vector<std::uint8_t> edges(pixels);
  raster::parallelFor(static_cast<std::size_t>((height + rowsOfTask - 1) / rowsOfTask), [&](std::size_t task) {
    const int first = static_cast<int>(task) * rowsOfTask, end = std::min(first + rowsOfTask, height);
    std::vector<SampleRow> rows;
    for (int row = 2 * first - 1; row <= 2 * end; ++row)
      rows.push_back(samples.row(std::clamp(row, 0, 2 * height - 1)));
    for (int row = first; row < end; ++row) {
      const std::span<const SampleRow, 4> around(&rows[2 * static_cast<std::size_t>(row - first)], 4);
      for (int column = 0; column < width; ++column) {
        edges[at(column, row)] = isAtEdge(test, around, column);
        if (!edges[at(column, row)]) image.pixels[at(column, row)] = meanColour(around[1], around[2], column);
      }
    }
  });
  // No two shifts are in one row or column, so that edges along these have eight levels, not four.
  for (const glm::vec2& shift : {glm::vec2(-0.125F, -0.375F), {0.375F, -0.125F}, {-0.375F, 0.125F}, {0.125F, 0.375F}}) {
    const TriangleSamples shifted = view.see(camera, 2 * width, 2 * height, skipped, shift);
    forEachRowWithEdges(edges, width, [&](int row, std::span<const std::uint8_t> ofRow) {
      std::vector<std::uint8_t> wanted;
      for (const std::uint8_t isEdge : ofRow) wanted.insert(wanted.end(), 2, isEdge);
      const SampleRow upper = shifted.row(2 * row, wanted), lower = shifted.row(2 * row + 1, wanted);
      for (int column = 0; column < width; ++column)
        if (edges[at(column, row)]) image.pixels[at(column, row)] += meanColour(upper, lower, column);
    });
  }
  for (std::size_t p = 0; p < pixels; ++p)
    if (edges[p]) image.pixels[p] /= 4.0;
  return image;
}

glm::dvec3 skyColour(const glm::dvec3& sky, double exposure) { return glm::min(sky * exposure, glm::dvec3(1.0)); }

glm::dvec3 unlitColour(const Scene& scene, const Visible& visible, const MapColour& mapColour) {
  const Material& material = scene.materials[static_cast<std::size_t>(scene.surfaces[visible.surface].material)];
  const Triangle& triangle = triangleOf(scene, visible);
  glm::dvec3 colour = material.reflectance;
  if (scene.surfaces[visible.surface].hasColours)
    colour *= interpolate(std::array<glm::dvec3, 3>{triangle.colour[0], triangle.colour[1], triangle.colour[2]},
                          visible.weights);
  if (material.reflectanceMap)
    colour *=
        mapColour(static_cast<std::size_t>(*material.reflectanceMap), interpolate(triangle.texcoord, visible.weights));
  return colour;
}

glm::dvec3 unlitColour(const Scene& scene, const Visible& visible) {
  return unlitColour(scene, visible,
                     [&](std::size_t image, const glm::dvec2& uv) { return bilinear(scene.images[image], uv); });
}

Image unlitPicture(const Scene& scene, const Camera& camera, int width, int height, const glm::dvec3& background) {
  return drawPicture(
      scene, camera, width, height, [&](const Visible& visible) { return unlitColour(scene, visible); }, background);
}

Image elementPicture(const Scene& scene, const Discretization& discretization, const ElementValues& values,
                     const Camera& camera, int width, int height, const glm::dvec3& background) {
  return drawPicture(
      scene, camera, width, height,
      [&](const Visible& visible) { return values(elementAt(scene, discretization, visible)); }, background);
}

Image wireframePicture(const Scene& scene, const Camera& camera, int width, int height) {
  return borderPicture(scene, camera, width, height, [&](const Visible& visible) {
    return ShownPiece{visible.surface, triangleOf(scene, visible).polygon};
  });
}

Image meshPicture(const Scene& scene, const Discretization& discretization, const Camera& camera, int width,
                  int height) {
  return borderPicture(scene, camera, width, height, [&](const Visible& visible) {
    return ShownPiece{visible.surface, triangleOf(scene, visible).polygon, elementAt(scene, discretization, visible)};
  });
}

}  // namespace hemitex::radiosity
