#include "reference/measurement/bench/baseline.h"

#include <algorithm>

#include "raster/base/parallel.h"

namespace hemitex::reference {
namespace {

/// Pixels per part; its buffers stay in the cache of a thread.
constexpr std::size_t part = 32768;

std::size_t pixelCount(const radiosity::Projection& projection) {
  std::size_t pixels = 0;
  for (const radiosity::ProjectionFace& face : projection.faces)
    pixels += static_cast<std::size_t>(face.scissor.width) * static_cast<std::size_t>(face.scissor.height);
  return pixels;
}

}  // namespace

BenchFloor::BenchFloor(const radiosity::Discretization& discretization, const radiosity::IdLayout& layout,
                       const radiosity::Projection& projection)
    : projection_(projection),
      faces_(radiosity::wholeFaces(projection)),
      counter_(discretization, layout),
      cleared_(pixelCount(projection)) {}

radiosity::FormFactorRow BenchFloor::row(std::span<const raster::ItemBuffer> ids) {
  raster::parallelFor((cleared_.size() + part - 1) / part, [this](std::size_t i) {
    const std::size_t first = i * part, count = std::min(part, cleared_.size() - first);
    fragments_.mine().assign(count * fragmentBytes, std::byte{0});
    std::fill_n(cleared_.begin() + static_cast<std::ptrdiff_t>(first), count, raster::ItemId{0});
  });
  return counter_.rowOf(projection_, faces_, ids);
}

}  // namespace hemitex::reference
