#include "raster/small_triangles.h"

#include <cassert>

namespace hemitex::raster {

std::uint32_t SmallTriangles::add(std::uint32_t cluster, const PlacedVertices& placed) {
  const std::size_t number = firstNumber + kept_.size() * largestCluster;
  assert(number + largestCluster <= noTriangle);
  const ClusterPart& part = draws_.mesh.parts[cluster];
  const std::vector<TriangleRun>& runs = draws_.clusters[cluster].runs;
  kept_.push_back({cluster, runs.size() == 1 ? runs.front().draw : severalDraws, part, w_.size()});
  const std::size_t count = part.vertices;
  across_.insert(across_.end(), placed.across.begin(), placed.across.begin() + count);
  down_.insert(down_.end(), placed.down.begin(), placed.down.begin() + count);
  w_.insert(w_.end(), placed.w.begin(), placed.w.begin() + count);
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
  return draws_.list
      .draws[kept.draw != severalDraws ? kept.draw : triangleOf(draws_.clusters[kept.cluster], inCluster(number)).draw];
}

bool SmallTriangles::facesAway(std::uint32_t number) const {
  const Kept& kept = keptOf(number);
  const std::size_t triangle = kept.part.firstTriangle + inCluster(number);
  const auto vertex = [&](std::size_t k) { return kept.firstVertex + draws_.mesh.corners[k][triangle]; };
  const std::size_t a = vertex(0), b = vertex(1), c = vertex(2);
  const std::int32_t area =
      (across_[b] - across_[a]) * (down_[c] - down_[a]) - (down_[b] - down_[a]) * (across_[c] - across_[a]);
  return (area < 0) == isMirrored_;
}

void SmallTriangles::show(std::uint32_t number, const Pixel& pixel, SmallPixels& pixels, std::size_t i) const {
  const Kept& kept = keptOf(number);
  const std::size_t triangle = kept.part.firstTriangle + inCluster(number);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t corner = draws_.mesh.corners[k][triangle], placed = kept.firstVertex + corner;
    const glm::vec2& texcoord = draws_.mesh.texcoords[kept.part.firstVertex + corner];
    pixels.across[k][i] = static_cast<float>(across_[placed] - (256 * pixel.column + 128));
    pixels.down[k][i] = static_cast<float>(down_[placed] - (256 * pixel.row + 128));
    pixels.w[k][i] = w_[placed];
    pixels.u[k][i] = texcoord.x;
    pixels.v[k][i] = texcoord.y;
  }
}

ScreenTriangle SmallTriangles::screenTriangle(std::uint32_t number) const {
  const Kept& kept = keptOf(number);
  const std::size_t first = kept.firstVertex;
  ScreenTriangle triangle;
  makeScreenTriangle(draws_.mesh, draws_.clusters[kept.cluster], kept.part, inCluster(number),
                     {across_.data() + first, down_.data() + first, w_.data() + first}, scissor_, isMirrored_,
                     triangle);
  return triangle;
}

}  // namespace hemitex::raster
