#include "cli/solve/run_size.h"

#include <algorithm>
#include <string>

#include "radiosity/discretization/grid_size.h"
#include "radiosity/images/image_module.h"
#include "raster/base/memory_budget.h"

namespace hemitex::cli {
namespace {

constexpr std::uint64_t ofProgram = 300'000'000, perSurface = 4300;

/// The rows that the cache may hold: about a patch has 16 elements and a row has 16 bytes per element.
std::uint64_t rowBytes(std::uint64_t elements, std::uint64_t budget) {
  return elements < 1 << 24 ? std::min(budget, elements * elements) : budget;
}

}  // namespace

void requireMemoryOfRun(const radiosity::Scene& scene, const SolveOptions& options) {
  const std::uint64_t elements = radiosity::totalTexels(radiosity::gridSizesOf(scene, options.discretization));
  raster::requireMemory(ofProgram + elements * radiosity::bytesPerElement + scene.surfaces.size() * perSurface +
                            radiosity::triangleCount(scene) * radiosity::bytesPerTriangle +
                            rowBytes(elements, options.solver.rowCacheBytes),
                        options.scene.file.string(), "the run with " + std::to_string(elements) + " elements",
                        "use larger texels or a smaller --row-cache");
  radiosity::requireSpaceForImages();
}

}  // namespace hemitex::cli
