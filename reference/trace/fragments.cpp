#include "reference/trace/fragments.h"

#include <algorithm>

#include "raster/setup/exact_interpolation.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::reference {
namespace {

using raster::ScreenTriangle;

/// A screen triangle and the triangle that it is a part of.
struct Part {
  ScreenTriangle screen;
  std::uint32_t triangle;
};

bool covers(const ScreenTriangle& triangle, int column, int row) {
  return std::all_of(triangle.edges.begin(), triangle.edges.end(), [=](const raster::Edge& edge) {
    const std::int64_t value = edge.at(column, row);
    return value > 0 || (value == 0 && edge.inclusive);
  });
}

/// Appends the parts of a triangle that cover the sample.
void appendParts(const raster::DrawList& list, const raster::Face& face, const DrawnTriangle& drawn, int column,
                 int row, std::vector<Part>& parts) {
  std::vector<ScreenTriangle> screen;
  const raster::TriangleRun run{drawn.draw, drawn.triangle, drawn.triangle + 1};
  raster::appendScreenTriangles(list, face, {&run, 1}, {}, screen);
  for (const ScreenTriangle& triangle : screen)
    if (covers(triangle, column, row)) parts.push_back({triangle, drawn.triangle});
}

void sortByDepth(std::vector<Part>& parts, int column, int row) {
  std::stable_sort(parts.begin(), parts.end(), [=](const Part& a, const Part& b) {
    return raster::isNearerExactly(a.screen, b.screen, column, row);
  });
}

/// Depth, coordinates and item ID of a part (raster rules, 6 and 7).
Fragment fragmentOf(const raster::DrawList& list, const Part& part, int column, int row) {
  const ScreenTriangle& triangle = part.screen;
  const raster::Draw& draw = list.draws[triangle.draw];
  double inverse = 0, u = 0, v = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = static_cast<double>(triangle.edges[k].at(column, row)) * triangle.inverseDepth[k];
    inverse += weight;
    u += weight * triangle.u[k];
    v += weight * triangle.v[k];
  }
  Fragment fragment{part.triangle, triangle.draw, triangle.facesAway, inverse, u / inverse, v / inverse, {}, {}};
  if (triangle.facesAway && draw.back) {
    fragment.id = *draw.back;
  } else if (!draw.indexMap) {
    fragment.id = draw.offset;
  } else {
    const raster::IndexMap& map = list.indexMaps[static_cast<std::size_t>(*draw.indexMap)];
    const Texel texel{raster::texelExactly(triangle, triangle.u, map.width, column, row),
                      raster::texelExactly(triangle, triangle.v, map.height, column, row)};
    const auto index = static_cast<std::size_t>(texel.row) * static_cast<std::size_t>(map.width) +
                       static_cast<std::size_t>(texel.column);
    fragment.texel = texel;
    fragment.id = raster::blend(list.format, list.blend, draw.offset, map.ids[index]);
  }
  return fragment;
}

}  // namespace

std::vector<DrawnTriangle> drawnTriangles(const raster::DrawList& list) {
  std::vector<DrawnTriangle> drawn;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw) {
    const std::uint32_t first = list.draws[draw].first / 3;
    for (std::uint32_t t = first; t < first + list.draws[draw].count / 3; ++t) drawn.push_back({draw, t});
  }
  return drawn;
}

std::vector<Fragment> fragmentsAt(const raster::DrawList& list, const raster::Face& face, int column, int row) {
  std::vector<Part> parts;
  for (const DrawnTriangle& drawn : drawnTriangles(list)) appendParts(list, face, drawn, column, row, parts);
  sortByDepth(parts, column, row);
  std::vector<Fragment> fragments;
  for (const Part& part : parts) fragments.push_back(fragmentOf(list, part, column, row));
  return fragments;
}

std::optional<Fragment> fragmentOf(const raster::DrawList& list, const raster::Face& face, const DrawnTriangle& drawn,
                                   int column, int row) {
  std::vector<Part> parts;
  appendParts(list, face, drawn, column, row, parts);
  if (parts.empty()) return {};
  sortByDepth(parts, column, row);
  return fragmentOf(list, parts.front(), column, row);
}

}  // namespace hemitex::reference
