/// Where the time of a whole solution goes, and what memory it takes, in a scene of very many elements.
#pragma once

#include <cstddef>

#include "radiosity/scene/scene.h"

namespace hemitex::reference {

/// Seconds of a solution of so many shots, the median over its repeats of each.
struct SolutionParts {
  std::size_t elements = 0;
  int resolution = 0, shots = 0;
  double start = 0;       ///< before the first shot: a pass over all elements
  double picking = 0;     ///< the next patch
  double hemicubes = 0;   ///< rows of form factors
  double spreading = 0;   ///< a shot's light over its row
  double accounting = 0;  ///< the residual after each shot; energy and radiosity in the end

  double besideOfTotal = 0;  ///< all but the hemicubes; the median over the repeats of what it is of each

  double beside() const { return start + picking + spreading + accounting; }
  double total() const { return beside() + hemicubes; }
};

/// Every surface of the scene with texels x texels elements, item IDs of 32 bits. Goes the solver's way
/// (progressive_solver.h) step by step, on the threads that are allowed.
SolutionParts solutionParts(const radiosity::Scene& scene, int texels, int resolution, int shots, int repeats);

/// What a solution takes above the scene itself while it sums a row: elements, patches, tables, index maps, light, item
/// buffers and the row. The differences of what the heap holds where elements are four times as many, or pixels.
struct SolutionMemory {
  double bytesPerElement = 0, bytesPerPixel = 0;
  std::size_t peakBytes = 0;  ///< of the process so far, scenes and code included
};

SolutionMemory solutionMemory(const radiosity::Scene& scene, int texels, int resolution);

}  // namespace hemitex::reference
