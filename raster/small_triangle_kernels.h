/// Small triangles: those that span less than six pixels either way. Where a scene is cut finely there is next to
/// nothing else, and setting each of them up as a screen triangle takes longer than its pixels do. So these kernels
/// take as many as a vector has lanes, straight from the placed vertices of their cluster. There is a plain version,
/// which says what they compute, and one for each SIMD instruction set that the processor has; all give the same
/// numbers, bit for bit.
///
/// Positions count from a sample near by: corners are less than 2^11 sub-pixels away from it and the values of edges
/// below 2^23, so that binary32 holds, and computes, them without rounding. 1/w and texels are decided in binary64
/// where its error bound allows (pixel_bounds.h); the caller decides the others exactly.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "raster/cluster_mesh.h"
#include "raster/pixel_kernels.h"
#include "raster/vertex_kernels.h"

namespace hemitex::raster {

/// Triangles of a part of a mesh whose vertices were placed.
struct OfferedTriangles {
  const ClusterMesh& mesh;
  const ClusterPart& part;
  const PlacedVertices& placed;
  std::uint32_t set;          ///< a bit each: some of TriangleSets::small
  std::uint32_t firstNumber;  ///< what a depth buffer calls the first of the part; the others count on
};

/// Samples of triangles that binary64 does not decide.
struct UndecidedSamples {
  struct Sample {
    std::uint32_t number;  ///< of the triangle
    Pixel pixel;
  };
  std::vector<Sample> samples;

  void add(std::uint32_t number, int column, int row);  // not inline, as UndecidedPixels::add
};

/// So many pixels are resolved at a time, more than a vector has lanes: what was just written is not read at once.
inline constexpr std::size_t mostSmallPixels = 32;

/// Pixels side by side and, corner by corner, the small triangles that they show.
struct SmallPixels {
  using Values = std::array<float, mostSmallPixels>;
  std::array<Values, 3> across, down;  ///< snapped positions less that of the pixel's sample
  std::array<Values, 3> w, u, v;
  std::array<double, mostSmallPixels> columns, rows;  ///< of the index map
};

/// What small pixels show.
struct SmallTexels {
  std::array<std::uint32_t, mostSmallPixels> texels;  ///< row * columns + column
  std::uint32_t decided = 0;                          ///< a bit for each that binary64 can tell
  std::uint32_t negative = 0;  ///< a bit for each where the area of the triangle is so (raster rules, 5)
};

struct SmallTriangleKernels {
  std::string name;  ///< plain, or that of an instruction set

  /// Offers the covered samples of triangles to a buffer, in any order: the larger 1/w wins. Appends samples where
  /// binary64 cannot tell which; where two of the triangles meet there, either may be the one. Returns whether any
  /// pixel took one.
  bool (*offer)(const OfferedTriangles& triangles, DepthBuffer& buffer, UndecidedSamples& undecided);

  /// The texels of the first `count` pixels.
  SmallTexels (*findTexels)(const SmallPixels& pixels, std::size_t count);
};

/// The specification of the others.
const SmallTriangleKernels& plainSmallTriangleKernels();
/// Those of every instruction set that this processor has, best first; none where hemitex was built without SIMD.
const std::vector<SmallTriangleKernels>& simdSmallTriangleKernels();
/// The first of simdSmallTriangleKernels(), else the plain ones.
const SmallTriangleKernels& bestSmallTriangleKernels();

}  // namespace hemitex::raster
