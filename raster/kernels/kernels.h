/// The inner loops of the renderer, compiled with Highway once per instruction set. All instruction sets give the same
/// results, bit for bit.
///
/// The kernels decide in double precision where its error bound (interpolation_bounds.h) allows. They list other pixels
/// as unresolved; the caller decides those exactly (exact_interpolation.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "raster/culling/cluster_mesh.h"
#include "raster/interface/face.h"
#include "raster/interface/item_id.h"
#include "raster/kernels/depth_buffer.h"
#include "raster/kernels/placed_vertices.h"
#include "raster/kernels/small_triangles.h"
#include "raster/kernels/texel_planes.h"
#include "raster/setup/triangle_setup.h"

namespace hemitex::raster {

/// Number of changes per element of the bit array of Kernels::findChanges.
inline constexpr std::size_t changesAtOnce = 64;

struct Kernels {
  const char* instructionSet;

  /// Transforms the vertices of a part of a mesh and classifies its triangles. Triangles in neither set cover no
  /// sample.
  TriangleSets (*place)(const ClusterMesh& mesh, const ClusterPart& part, const Face& face, PlacedVertices& placed);

  /// Sets up small triangles for a part of a face.
  void (*setUpSmall)(const SmallTriangles& triangles, const Scissor& part, SmallSetup& setup);

  /// Draws the triangles of a setup: the larger 1/w wins. `firstNumber` is the number of the first triangle of the
  /// part in the buffer. Appends samples that are not resolved in double precision. If the texel is not, the buffer
  /// has the sample already, and its item ID is unspecified.
  void (*drawSmall)(const SmallSetup& setup, const SmallIds& ids, std::uint32_t firstNumber, DepthBuffer& buffer,
                    UnresolvedSamples& unresolved);

  /// Depth test of the covered samples of a triangle: the larger 1/w wins. Rows and columns of the triangle must lie in
  /// the scissor rectangle of the buffer, and the buffer must not contain `number` before. Appends the samples that are
  /// not resolved in double precision. Returns whether any pixel took the triangle.
  bool (*testDepths)(const ScreenTriangle& triangle, std::uint32_t number, DepthBuffer& buffer,
                     UnresolvedPixels& unresolved);

  /// Whether 1/w of all pixels in a part of the buffer's scissor rectangle is larger than `inverseDepth`. The caller
  /// adds the rounding error to inverseDepth.
  bool (*isHidden)(const DepthBuffer& buffer, const Scissor& part, double inverseDepth);

  /// The end of the run of pixels from `first` that show the same triangle; at most `end`.
  int (*endOfRun)(const std::uint32_t* triangles, int first, int end);

  /// The end of the pixels from `first` that show small triangles; at most `end`.
  int (*endOfSmall)(const std::uint32_t* triangles, int first, int end);

  /// The texels of a run: `base` + row * width + column each. Appends the pixels whose texels are not resolved in
  /// double precision; their entries of `texels` are unspecified. Kernels may write up to maxLanes texels behind the
  /// run and read as many depths.
  void (*findTexels)(const PixelRun& run, const TexelPlanes& planes, std::uint32_t base, std::uint32_t* texels,
                     UnresolvedPixels& unresolved);

  /// As findTexels, for a triangle whose coordinates are exact quotients. It is slower and resolves all texels.
  void (*findExactTexels)(const PixelRun& run, const ExactTexels& exact, int width, int height, std::uint32_t base,
                          std::uint32_t* texels);

  /// Sets bit i % 64 of changes[i / 64] if ids[i] differs from ids[i - 1], else clears it. ids[-1] must be readable.
  /// Bits from `count` on are cleared.
  void (*findChanges)(const ItemId* ids, std::size_t count, std::uint64_t* changes);
};

/// The kernels of each instruction set that this processor has, fastest first; at least one.
const std::vector<Kernels>& allKernels();

/// The fastest of them.
inline const Kernels& bestKernels() { return allKernels().front(); }

}  // namespace hemitex::raster
