#include "cli/solve/run_size.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

#include "cli/common/numbers.h"
#include "radiosity/discretization/grid_size.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

constexpr std::uint64_t mostElements = 1 << 24;

// Bytes of a run, as measured: see docs/performance.md.
constexpr std::uint64_t ofProgram = 300'000'000, perElement = 100, perSurface = 4300, perTriangle = 800;

/// The rows that the cache may hold: about a patch has 16 elements and a row has 16 bytes per element.
std::uint64_t rowBytes(std::uint64_t elements, std::uint64_t budget) {
  return elements < 1 << 24 ? std::min(budget, elements * elements) : budget;
}

std::string gigabytes(std::uint64_t bytes) { return roundedText(static_cast<double>(bytes) / 1e9) + " GB"; }

const char* const advice = "use a larger --texel-size or smaller --texels, or --insist to run all the same";

}  // namespace

RunSize runSize(const radiosity::Scene& scene, const SolveOptions& options) {
  RunSize size;
  for (const radiosity::GridSize& grid : radiosity::gridSizesOf(scene, options.discretization))
    size.elements += static_cast<std::uint64_t>(grid.columns) * static_cast<std::uint64_t>(grid.rows);
  size.bytes = ofProgram + size.elements * perElement + scene.surfaces.size() * perSurface +
               radiosity::triangleCount(scene) * perTriangle + rowBytes(size.elements, options.solver.rowCacheBytes);
  return size;
}

void requireAffordable(const RunSize& size, std::optional<std::uint64_t> freeBytes) {
  const std::string elements = "the scene becomes " + std::to_string(size.elements) + " elements";
  if (freeBytes && size.bytes > *freeBytes)
    throw raster::InputError(
        elements + ", and the run takes about " + gigabytes(size.bytes) + "; " + gigabytes(*freeBytes) + " are free",
        advice);
  if (size.elements > mostElements)
    throw raster::InputError(elements + ", more than " + std::to_string(mostElements) + "; the run takes about " +
                                 gigabytes(size.bytes) + " and long",
                             advice);
}

std::optional<std::uint64_t> freeMemory() {
  std::ifstream file("/proc/meminfo");
  for (std::string name; file >> name; file.ignore(std::numeric_limits<std::streamsize>::max(), '\n'))
    if (std::uint64_t kibibytes = 0; name == "MemAvailable:" && file >> kibibytes) return kibibytes << 10;
  return std::nullopt;
}

}  // namespace hemitex::cli
