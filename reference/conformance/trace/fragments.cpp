#include "reference/conformance/trace/fragments.h"

#include <algorithm>

#include "raster/interface/depth_test.h"

namespace hemitex::reference {

std::vector<DrawnTriangle> drawnTriangles(const raster::DrawList& list) {
  std::vector<DrawnTriangle> drawn;
  for (std::uint32_t draw = 0; draw < list.draws.size(); ++draw) {
    const std::uint32_t first = list.draws[draw].first / 3;
    for (std::uint32_t t = first; t < first + list.draws[draw].count / 3; ++t) drawn.push_back({draw, t});
  }
  return drawn;
}

Fragment fragmentOf(const raster::DrawList& list, const raster::CoveredSample& sample) {
  const raster::SnappedTriangle& triangle = *sample.triangle;
  const auto overDepth = raster::weightsOverDepth<double>(triangle, sample.weights);
  const std::optional<Texel> texel = raster::texelOf(list, sample);
  return {triangle.number,
          triangle.draw,
          triangle.facesAway,
          sample.inverseDepth,
          raster::interpolated(triangle, overDepth, &raster::ViewVertex::u),
          raster::interpolated(triangle, overDepth, &raster::ViewVertex::v),
          texel,
          raster::pixelValue(list, sample),
          triangle};
}

namespace {

/// How many of the samples, in draw order, pass the depth test.
raster::ItemId passedAt(const raster::DrawList& list, const std::vector<raster::CoveredSample>& covered) {
  raster::CoveredSample shown;
  for (const raster::CoveredSample& sample : covered)
    if (!shown.triangle || passes(list.depthTest, sample, shown, raster::isNearer)) {
      const raster::ItemId passed = shown.passed + 1;
      shown = sample;
      shown.passed = passed;
    }
  return shown.passed;
}

}  // namespace

std::vector<Fragment> fragmentsAt(const raster::DrawList& list, std::span<const raster::SnappedTriangle> triangles,
                                  int column, int row) {
  std::vector<raster::CoveredSample> covered;
  for (const raster::SnappedTriangle& triangle : triangles) {
    const raster::Weights weights = weightsAt(triangle, raster::sampleOf(column, row));
    if (!covers(triangle, weights)) continue;
    const raster::CoveredSample sample = coveredSample(triangle, weights);
    if (!isHole(list, sample)) covered.push_back(sample);
  }
  const raster::ItemId passed = passedAt(list, covered);
  const bool isReversed = keepsFarther(list.depthTest);
  if (keepsLast(list.depthTest)) std::reverse(covered.begin(), covered.end());
  std::stable_sort(covered.begin(), covered.end(), [=](const raster::CoveredSample& a, const raster::CoveredSample& b) {
    return isReversed ? isNearer(b, a) : isNearer(a, b);
  });
  std::vector<Fragment> fragments;
  for (raster::CoveredSample& sample : covered) {
    sample.passed = passed;
    fragments.push_back(fragmentOf(list, sample));
  }
  return fragments;
}

}  // namespace hemitex::reference
