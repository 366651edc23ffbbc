/// The small triangles of a tile (small_triangle_kernels.h). A pixel remembers but a number; what else there is to know
/// of a triangle comes from the placed vertices of its cluster, which are all that is kept.
#pragma once

#include <cstdint>
#include <vector>

#include "raster/pixel_kernels.h"
#include "raster/prepared_draws.h"
#include "raster/screen_triangle.h"
#include "raster/small_triangle_kernels.h"
#include "raster/vertex_kernels.h"

namespace hemitex::raster {

class SmallTriangles {
 public:
  SmallTriangles(const PreparedDraws& draws, const Scissor& scissor, bool isMirrored)
      : draws_(draws), scissor_(scissor), isMirrored_(isMirrored) {}

  /// Whether a number, not noTriangle, is one of these, not of a screen triangle.
  static bool holds(std::uint32_t number) { return number >= firstNumber; }

  /// Keeps the placed vertices of a cluster; the number of its first triangle.
  std::uint32_t add(std::uint32_t cluster, const PlacedVertices& placed);
  /// Forgets the cluster that was added last.
  void removeLast();

  const Draw& drawOf(std::uint32_t number) const;
  /// Makes the `i`th of `pixels` one that shows it; what the index map is like stays to be said.
  void show(std::uint32_t number, const Pixel& pixel, SmallPixels& pixels, std::size_t i) const;
  ScreenTriangle screenTriangle(std::uint32_t number) const;

 private:
  static constexpr std::uint32_t firstNumber = 0x80000000, severalDraws = 0xffffffff;

  struct Kept {
    std::uint32_t cluster;
    std::uint32_t draw;       ///< of all triangles of the cluster, or severalDraws
    ClusterPart part;         ///< of the mesh
    std::size_t firstVertex;  ///< below
  };
  struct Vertex {
    std::int32_t across, down;
    float w;
    glm::vec2 texcoord;
  };
  const Kept& keptOf(std::uint32_t number) const { return kept_[(number - firstNumber) / largestCluster]; }
  static std::uint32_t inCluster(std::uint32_t number) { return (number - firstNumber) % largestCluster; }
  Vertex vertex(std::uint32_t number, std::size_t corner) const;

  const PreparedDraws& draws_;
  Scissor scissor_;
  bool isMirrored_;
  std::vector<Kept> kept_;
  std::vector<std::int32_t> across_, down_;  ///< of the vertices of kept clusters
  std::vector<float> w_;
};

}  // namespace hemitex::raster
