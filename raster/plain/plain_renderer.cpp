#include "raster/plain/plain_renderer.h"

#include <algorithm>

#include "raster/interface/assembly.h"

namespace hemitex::raster {
namespace {

/// Appends what remains of triangle t after clipping.
void append(std::vector<SnappedTriangle>& triangles, const DrawList& list, const Face& face, std::uint32_t draw,
            std::uint32_t t) {
  const ClippedPolygon polygon = clip(face, list, t);
  for (std::size_t k = 2; k < polygon.count; ++k) {
    const auto& [a, b, c] = fanTriangle(polygon, k);
    SnappedTriangle triangle = snappedTriangle(list, face, {a, b, c}, {snap(face, a), snap(face, b), snap(face, c)});
    triangle.draw = draw;
    triangle.number = t;
    triangle.piece = static_cast<int>(k) - 2;
    if (triangle.area != 0 && !isCulled(list.draws[draw], triangle.facesAway)) triangles.push_back(triangle);
  }
}

void drawFace(const DrawList& list, const Face& face, std::span<const std::uint32_t> skipped, ItemBuffer& buffer) {
  const std::vector<SnappedTriangle> triangles = snappedTriangles(list, face, skipped);
  const std::vector<CoveredSample> visible = visibleSamples(list, triangles, face.scissor);
  buffer.resize(face.scissor);
  for (std::size_t pixel = 0; pixel < visible.size(); ++pixel) buffer.ids[pixel] = pixelValue(list, visible[pixel]);
}

}  // namespace

std::vector<SnappedTriangle> snappedTriangles(const DrawList& list, const Face& face,
                                              std::span<const std::uint32_t> skipped) {
  std::vector<SnappedTriangle> triangles;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw) {
    const std::uint32_t first = list.draws[draw].first / 3, end = first + list.draws[draw].count / 3;
    for (std::uint32_t t = first; t < end; ++t)
      if (!std::binary_search(skipped.begin(), skipped.end(), t)) append(triangles, list, face, draw, t);
  }
  return triangles;
}

std::vector<CoveredSample> visibleSamples(const DrawList& list, std::span<const SnappedTriangle> triangles,
                                          const Scissor& scissor) {
  std::vector<CoveredSample> visible(static_cast<std::size_t>(scissor.width) *
                                     static_cast<std::size_t>(scissor.height));
  for (const SnappedTriangle& triangle : triangles) {
    const auto& [a, b, c] = triangle.corners;
    const PixelRange columns = samplesBetween(a.x, b.x, c.x, scissor.column, scissor.column + scissor.width);
    const PixelRange rows = samplesBetween(a.y, b.y, c.y, scissor.row, scissor.row + scissor.height);
    for (int row = rows.first; row < rows.end; ++row)
      for (int column = columns.first; column < columns.end; ++column) {
        const Weights weights = weightsAt(triangle, sampleOf(column, row));
        if (!covers(triangle, weights)) continue;
        const auto pixel = static_cast<std::size_t>((row - scissor.row) * scissor.width + column - scissor.column);
        CoveredSample sample = coveredSample(triangle, weights);
        sample.passed = visible[pixel].passed + 1;
        // A hole is looked up only where it would be seen, which gives the same pixels.
        const bool isSeen = !visible[pixel].triangle || passes(list.depthTest, sample, visible[pixel], isNearer);
        if (isSeen && !isHole(list, sample)) visible[pixel] = sample;
      }
  }
  return visible;
}

PlainRenderer::PlainRenderer(const DrawList& list) : list_(assembled(list)) { validate(list_); }

void PlainRenderer::draw(std::span<const Face> faces, std::span<const std::uint32_t> skipped,
                         std::vector<ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) {
  buffers.resize(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    validate(faces[f]);
    drawFace(list_, faces[f], skipped, buffers[f]);
    drawn(f);
  }
}

}  // namespace hemitex::raster
