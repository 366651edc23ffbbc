#include "reference/conformance/trace/fragments.h"

#include <algorithm>
#include <iterator>

#include "raster/setup/exact_interpolation.h"

namespace hemitex::reference {
namespace {

using raster::ScreenTriangle;

/// Depth, coordinates and item ID of a triangle at a sample that it covers.
Fragment fragmentOf(const raster::DrawList& list, const ScreenTriangle& triangle, int column, int row) {
  const raster::Draw& draw = list.draws[triangle.draw];
  double inverse = 0, u = 0, v = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double weight = static_cast<double>(triangle.edges[k].at(column, row)) * triangle.inverseDepth[k];
    inverse += weight;
    u += weight * triangle.u[k];
    v += weight * triangle.v[k];
  }
  Fragment fragment{triangle.number, triangle.draw, triangle.facesAway, inverse, u / inverse, v / inverse, {}, {},
                    triangle};
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

std::vector<ScreenTriangle> screenTriangles(const raster::DrawList& list, const raster::Face& face,
                                            std::span<const DrawnTriangle> drawn) {
  std::vector<raster::TriangleRun> runs;
  for (const DrawnTriangle& each : drawn) runs.push_back({each.draw, each.triangle, each.triangle + 1});
  std::vector<ScreenTriangle> triangles;
  raster::appendScreenTriangles(list, face, runs, {}, triangles);
  return triangles;
}

std::vector<ScreenTriangle> screenTriangles(const raster::DrawList& list, const raster::Face& face) {
  return screenTriangles(list, face, drawnTriangles(list));
}

std::vector<Fragment> fragmentsAt(const raster::DrawList& list, std::span<const ScreenTriangle> triangles, int column,
                                  int row) {
  std::vector<ScreenTriangle> covering;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(covering),
               [=](const ScreenTriangle& triangle) { return covers(triangle, column, row); });
  std::stable_sort(covering.begin(), covering.end(), [=](const ScreenTriangle& a, const ScreenTriangle& b) {
    return raster::isNearerExactly(a, b, column, row);
  });
  std::vector<Fragment> fragments;
  for (const ScreenTriangle& triangle : covering) fragments.push_back(fragmentOf(list, triangle, column, row));
  return fragments;
}

}  // namespace hemitex::reference
