#include "radiosity/cut_outs/texel_mask.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "radiosity/cut_outs/chart_map.h"

namespace hemitex::radiosity {
namespace {

using TextureMap = AffineMap<glm::dvec2>;

/// The number of pixels of a cut-out along the axes of a chart.
glm::dvec2 pixelsAlong(const CutOut& cutOut, const TextureMap& map) {
  const glm::dvec2 size(cutOut.width, cutOut.height);
  const auto along = [&](const glm::dvec2& axis) {
    const glm::dvec2 pixels = glm::abs(size * (cutOut.sampler(axis) - cutOut.sampler(glm::dvec2(0))));
    return std::max({pixels.x, pixels.y, 1.0});
  };
  return {along(map.alongU), along(map.alongV)};
}

/// The number of texels of the mask per texel of the grid. The factor allows for the rounding of charts.
int texelsPerTexel(double pixels, int texels) {
  const double wanted = std::ceil(pixels * (1 - 1e-6) / texels);
  return static_cast<int>(std::clamp(wanted, 1.0, std::max(1.0, std::floor(double(largestMask) / texels))));
}

/// Barycentric weights of all corners of a triangle.
glm::dvec3 weightsOf(const std::array<glm::dvec2, 3>& corner, const glm::dvec2& point) {
  const glm::dvec2 a = corner[1] - corner[0], b = corner[2] - corner[0], p = point - corner[0];
  const double area = a.x * b.y - a.y * b.x, second = (p.x * b.y - p.y * b.x) / area,
               third = (a.x * p.y - a.y * p.x) / area;
  return {1 - second - third, second, third};
}

TexelMask emptyMask(int columns, int rows) {
  return {columns, rows, std::vector<bool>(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))};
}

TexelMask maskOf(const CutOut& cutOut, const TextureMap& map, int columns, int rows) {
  TexelMask mask = emptyMask(columns, rows);
  std::size_t texel = 0;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column)
      mask.isHole[texel++] = isHoleAt(cutOut, map((glm::dvec2(column, row) + 0.5) / glm::dvec2(columns, rows)));
  return mask;
}

/// Of the triangles at the middle of a texel, the one that contains it most decides; without one there, that which is
/// nearest in its weights, at its border.
TexelMask maskOf(const CutOut& cutOut, const Surface& surface, int columns, int rows) {
  TexelMask mask = emptyMask(columns, rows);
  std::vector<double> inside(mask.isHole.size(), std::numeric_limits<double>::lowest());
  const glm::dvec2 size(columns, rows);
  for (const Triangle& triangle : surface.triangles) {
    const auto& [a, b, c] = triangle.chart;
    const glm::ivec2 low = glm::max(glm::ivec2(glm::floor(glm::min(glm::min(a, b), c) * size)) - 1, glm::ivec2(0)),
                     high = glm::min(glm::ivec2(glm::ceil(glm::max(glm::max(a, b), c) * size)) + 1,
                                     glm::ivec2(columns, rows));
    for (int row = low.y; row < high.y; ++row)
      for (int column = low.x; column < high.x; ++column) {
        glm::dvec3 weights = weightsOf(triangle.chart, (glm::dvec2(column, row) + 0.5) / size);
        const double least = std::min({weights.x, weights.y, weights.z});
        const auto texel =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
        if (least <= inside[texel]) continue;
        inside[texel] = least;
        weights = glm::max(weights, 0.0);
        weights /= weights.x + weights.y + weights.z;
        mask.isHole[texel] = isHole(cutOut, triangle, {weights.y, weights.z});
      }
  }
  return mask;
}

/// A rectangle of texels.
struct TexelBox {
  std::int64_t left, right, bottom, top;
};

/// The texels of a mask that meet the rectangle [low, high].
TexelBox texelsIn(const TexelMask& mask, const glm::dvec2& size, const glm::dvec2& low, const glm::dvec2& high) {
  const auto begin = [](double at, int texels) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(at)), 0, texels - 1);
  };
  const auto end = [](double at, int texels) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::ceil(at)), 1, texels);
  };
  const glm::dvec2 scale = glm::dvec2(mask.columns, mask.rows) / size, from = low * scale, to = high * scale;
  const TexelBox box{begin(from.x, mask.columns), end(to.x, mask.columns), begin(from.y, mask.rows),
                     end(to.y, mask.rows)};
  return {box.left, std::max(box.right, box.left + 1), box.bottom, std::max(box.top, box.bottom + 1)};
}

bool isHoleIn(const TexelMask& mask, std::int64_t column, std::int64_t row) {
  return mask.isHole[static_cast<std::size_t>(row * mask.columns + column)];
}

/// Visits rectangles that cover the texels of a box that are no holes: rows of runs, joined where rows have the same.
void forEachOpaqueBox(const TexelMask& mask, const TexelBox& box, const std::function<void(const TexelBox&)>& visit) {
  std::vector<TexelBox> open, next;
  for (std::int64_t row = box.bottom; row <= box.top; ++row) {
    next.clear();
    for (std::int64_t column = box.left; row < box.top && column < box.right; ++column) {
      if (isHoleIn(mask, column, row)) continue;
      const std::int64_t left = column;
      while (column < box.right && !isHoleIn(mask, column, row)) ++column;
      const auto same = std::find_if(open.begin(), open.end(), [&](const TexelBox& before) {
        return before.left == left && before.right == column;
      });
      next.push_back({left, column, same == open.end() ? row : same->bottom, row + 1});
      if (same != open.end()) open.erase(same);
    }
    for (const TexelBox& ended : open) visit(ended);
    std::swap(open, next);
  }
}

}  // namespace

std::shared_ptr<const TexelMask> TexelMasks::of(const Surface& surface, int columns, int rows) {
  const CutOut* const cutOut = cutOutOf(scene_, surface);
  if (cutOut == nullptr) return nullptr;
  const std::optional<TextureMap> map = textureMap(surface, cutOut->sampler, {cutOut->width, cutOut->height});
  glm::dvec2 pixels(1);
  std::vector<double> places;
  if (map) {
    pixels = pixelsAlong(*cutOut, *map);
    places = {map->alongU.x, map->alongU.y, map->alongV.x, map->alongV.y, map->origin.x, map->origin.y};
  } else {
    for (const Triangle& triangle : surface.triangles) {
      pixels = glm::max(pixels, pixelsAlong(*cutOut, TextureMap(triangle.chart, triangle.texcoord)));
      for (std::size_t k = 0; k < 3; ++k)
        places.insert(places.end(),
                      {triangle.chart[k].x, triangle.chart[k].y, triangle.texcoord[k].x, triangle.texcoord[k].y});
    }
  }
  const int maskColumns = columns * texelsPerTexel(pixels.x, columns), maskRows = rows * texelsPerTexel(pixels.y, rows);
  const auto [known, isNew] = known_.try_emplace({cutOut, maskColumns, maskRows, std::move(places)});
  if (isNew)
    known->second = std::make_shared<TexelMask>(map ? maskOf(*cutOut, *map, maskColumns, maskRows)
                                                    : maskOf(*cutOut, surface, maskColumns, maskRows));
  return known->second;
}

std::shared_ptr<const TexelMask> TexelMasks::ofPixels(const CutOut& cutOut) {
  const auto [known, isNew] = known_.try_emplace({&cutOut, cutOut.width, cutOut.height, {}});
  if (isNew) {
    TexelMask mask{cutOut.width, cutOut.height, {}};
    for (std::ptrdiff_t row = cutOut.height - 1; row >= 0; --row) {
      const auto begin = cutOut.isHole.begin() + row * cutOut.width;
      mask.isHole.insert(mask.isHole.end(), begin, begin + cutOut.width);
    }
    known->second = std::make_shared<TexelMask>(std::move(mask));
  }
  return known->second;
}

bool hasHole(const TexelMask& mask, const glm::dvec2& size, const glm::dvec2& low, const glm::dvec2& high) {
  const TexelBox box = texelsIn(mask, size, low, high);
  for (std::int64_t row = box.bottom; row < box.top; ++row)
    for (std::int64_t column = box.left; column < box.right; ++column)
      if (isHoleIn(mask, column, row)) return true;
  return false;
}

void forEachOpaquePart(const TexelMask& mask, const glm::dvec2& size, const Piece& piece,
                       const std::function<void(const Piece&)>& visit) {
  if (piece.size == 0) return;
  glm::dvec2 low = piece.corners[0].grid, high = low;
  for (std::size_t i = 1; i < piece.size; ++i) {
    low = glm::min(low, piece.corners[i].grid);
    high = glm::max(high, piece.corners[i].grid);
  }
  if (!hasHole(mask, size, low, high)) return visit(piece);
  const auto at = [&](std::int64_t column, std::int64_t row) {
    return glm::dvec2(column, row) * size / glm::dvec2(mask.columns, mask.rows);
  };
  forEachOpaqueBox(mask, texelsIn(mask, size, low, high), [&](const TexelBox& box) {
    const Piece part = clippedTo(piece, at(box.left, box.bottom), at(box.right, box.top));
    if (part.size > 0 && share(part) > 0) visit(part);
  });
}

}  // namespace hemitex::radiosity
