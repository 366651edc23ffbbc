/// Measures the time of each part of a solution and its memory, in scenes with very many elements.
#pragma once

#include <cstddef>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// Seconds of the parts of a solution; each is the median of the repetitions.
struct SolutionParts {
  std::size_t elements = 0;
  int resolution = 0, shots = 0;
  double start = 0;       ///< work before the first shot: a pass over all elements
  double picking = 0;     ///< selecting the next patch
  double hemicubes = 0;   ///< computing form-factor rows
  double spreading = 0;   ///< distributing the light of a shot over its row
  double accounting = 0;  ///< residual after each shot; energy and radiosity at the end

  double besideOfTotal = 0;  ///< share of all parts except hemicubes; median of the repetitions

  double beside() const { return start + picking + spreading + accounting; }
  double total() const { return beside() + hemicubes; }
};

/// Measures a solution with texels x texels elements per surface and item IDs of 32 bits. Repeats the steps of the
/// solver (progressive_solver.h) one by one, on all permitted threads.
SolutionParts solutionParts(const radiosity::Scene& scene, int texels, int resolution, int shots, int repeats);

/// Memory of a solution while it sums a row, without the scene: elements, patches, tables, index maps, light, item
/// buffers and the row. Bytes per element and per pixel are differences of the heap size. The second solution has four
/// times as many elements, or pixels.
struct SolutionMemory {
  double bytesPerElement = 0, bytesPerPixel = 0;
  std::size_t peakBytes = 0;  ///< of the process so far, including scenes and code
};

/// Measures the memory on one thread; needs an allocator that supports mallinfo2.
SolutionMemory solutionMemory(const radiosity::Scene& scene, int texels, int resolution);

}  // namespace hemitex::reference
