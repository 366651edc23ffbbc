#include "reference/measurement/tradeoff/methods.h"

#include <memory>
#include <utility>

#include "radiosity/form_factors/level_of_detail.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "reference/truth/rays/embree_form_factors.h"

namespace hemitex::reference {
namespace {

using radiosity::Discretization;
using radiosity::Scene;

/// A drawn method: projection, rotation and splitting of patches.
struct DrawnStyle {
  std::string name;
  radiosity::ProjectionKind projection;
  radiosity::Orientation orientation;
  double split;  ///< see radiosity::DrawingSettings
  std::vector<int> measured;
  double pixelsPerElement = 0;  ///< see radiosity::ViewSettings
};

/// Pixels of all faces of a projection; a hemicube has one square face and four halves.
double pixelsOf(radiosity::ProjectionKind projection, int resolution) {
  return (projection == radiosity::ProjectionKind::SinglePlane ? 1.0 : 3.0) * resolution * resolution;
}

/// Pixels with a delta form factor above 0; for a cubic tetrahedron these are half of each face and its diagonal.
double directionsOf(radiosity::ProjectionKind projection, int resolution) {
  const double pixels = pixelsOf(projection, resolution);
  return projection == radiosity::ProjectionKind::CubicTetrahedron ? (pixels + 3.0 * resolution) / 2 : pixels;
}

TradeMethod drawnMethod(const DrawnStyle& style) {
  const auto rows = [style](const Scene& scene, const Discretization& discretization, int resolution) -> TradeRows {
    const radiosity::DrawingSettings settings{resolution,       style.orientation,
                                              style.split,      radiosity::ElementsBy::Texture,
                                              style.projection, style.pixelsPerElement};
    const auto drawn = std::make_shared<radiosity::SceneFormFactors>(scene, discretization,
                                                                     radiosity::layOut(discretization), settings);
    return {{drawn, &drawn->discretization()},
            [drawn](std::uint32_t patch) { return drawn->rows().ofPatch(patch); },
            drawn->splits()};
  };
  const auto directions = [style](int resolution) { return directionsOf(style.projection, resolution); };
  const auto bytes = [style](int resolution) {
    return static_cast<std::size_t>(pixelsOf(style.projection, resolution)) * sizeof(raster::ItemId);
  };
  return {style.name, "resolution", 2, 4096, style.measured, directions, bytes, rows};
}

TradeMethod rayMethod(const std::string& name, RayStart start, std::uint32_t seed) {
  const auto rows = [start, seed](const Scene& scene, const Discretization& discretization, int rays) -> TradeRows {
    const auto kept = std::make_shared<const Discretization>(discretization);
    const auto rayRows = std::make_shared<RayRows>(scene, *kept, RayRowSettings{rays, start, seed});
    return {kept, [kept, rayRows](std::uint32_t patch) { return rayRows->ofPatch(patch); }};
  };
  // A direction and a start point.
  const auto bytes = [](int rays) { return static_cast<std::size_t>(rays) * 5 * sizeof(float); };
  return {name,
          "rays",
          16,
          1 << 24,
          {1 << 8, 1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20},
          [](int rays) { return static_cast<double>(rays); },
          bytes,
          rows};
}

}  // namespace

std::vector<TradeMethod> tradeMethods(std::uint32_t seed) {
  using radiosity::Orientation;
  using radiosity::ProjectionKind;
  const std::vector<int> few{32, 64, 128, 256, 512};
  const double split = radiosity::defaultMaxMisdirected, unsplit = 1;
  const std::vector<int> many{32, 64, 128, 256, 512, 1024, 2048};
  return {drawnMethod({"hemicube", ProjectionKind::Hemicube, Orientation::Aligned, unsplit, many}),
          drawnMethod({"turned-hemicube", ProjectionKind::Hemicube, Orientation::Turned, unsplit, few}),
          drawnMethod({"split-hemicube", ProjectionKind::Hemicube, Orientation::Turned, split, few}),
          drawnMethod({"single-plane", ProjectionKind::SinglePlane, Orientation::Turned, unsplit, few}),
          drawnMethod({"tetrahedron", ProjectionKind::CubicTetrahedron, Orientation::Turned, unsplit, few}),
          drawnMethod({"levels-of-detail", ProjectionKind::Hemicube, Orientation::Turned, unsplit, few,
                       radiosity::suggestedPixelsPerElement}),
          rayMethod("centre-rays", RayStart::Centre, seed),
          rayMethod("area-rays", RayStart::Area, seed)};
}

}  // namespace hemitex::reference
