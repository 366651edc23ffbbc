#include "raster/small_triangles.h"

#include <cassert>

namespace hemitex::raster {

std::uint32_t SmallTriangles::add(std::uint32_t cluster, const PlacedVertices& placed) {
  const std::size_t number = firstNumber + kept_.size() * largestCluster;
  assert(number + largestCluster <= noTriangle);
  const ClusterPart& part = draws_.mesh.parts[cluster];
  const std::vector<TriangleRun>& runs = draws_.clusters[cluster].runs;
  kept_.push_back({cluster, runs.size() == 1 ? runs.front().draw : severalDraws, part, w_.size()});
  const auto append = [&part](const auto& values, auto& kept) {
    kept.insert(kept.end(), values.begin(), values.begin() + part.vertices);
  };
  append(placed.across, across_);
  append(placed.down, down_);
  append(placed.w, w_);
  return static_cast<std::uint32_t>(number);
}

void SmallTriangles::removeLast() {
  const std::size_t end = kept_.back().firstVertex;
  across_.resize(end);
  down_.resize(end);
  w_.resize(end);
  kept_.pop_back();
}

const Draw& SmallTriangles::drawOf(std::uint32_t number) const {
  const Kept& kept = keptOf(number);
  const std::uint32_t draw =
      kept.draw != severalDraws ? kept.draw : triangleOf(draws_.clusters[kept.cluster], inCluster(number)).draw;
  return draws_.list.draws[draw];
}

SmallTriangles::Vertex SmallTriangles::vertex(std::uint32_t number, std::size_t corner) const {
  const Kept& kept = keptOf(number);
  const std::size_t inPart = draws_.mesh.corners[corner][kept.part.firstTriangle + inCluster(number)];
  const std::size_t placed = kept.firstVertex + inPart;
  return {across_[placed], down_[placed], w_[placed], draws_.mesh.texcoords[kept.part.firstVertex + inPart]};
}

void SmallTriangles::show(std::uint32_t number, const Pixel& pixel, SmallPixels& pixels, std::size_t i) const {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vertex corner = vertex(number, k);
    pixels.across[k][i] = static_cast<float>(corner.across - (256 * pixel.column + 128));
    pixels.down[k][i] = static_cast<float>(corner.down - (256 * pixel.row + 128));
    pixels.w[k][i] = corner.w;
    pixels.u[k][i] = corner.texcoord.x;
    pixels.v[k][i] = corner.texcoord.y;
  }
}

ScreenTriangle SmallTriangles::screenTriangle(std::uint32_t number) const {
  std::array<SnappedPoint, 3> snapped;
  std::array<ViewVertex, 3> vertices;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vertex corner = vertex(number, k);
    snapped[k] = {corner.across, corner.down};
    vertices[k] = {0, 0, corner.w, corner.texcoord.x, corner.texcoord.y};
  }
  const TriangleRun one = triangleOf(draws_.clusters[keptOf(number).cluster], inCluster(number));
  ScreenTriangle triangle;
  makeScreenTriangle(scissor_, snapped, vertices, isMirrored_, triangle);
  triangle.draw = one.draw;
  triangle.number = one.first;
  return triangle;
}

}  // namespace hemitex::raster
