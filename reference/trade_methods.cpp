#include "reference/trade_methods.h"

#include <memory>
#include <utility>

#include "radiosity/drawn_rows.h"
#include "reference/ray_rows.h"

namespace hemitex::reference {
namespace {

using radiosity::Discretization;
using radiosity::RowSource;
using radiosity::Scene;

/// How hemicubes stand, and which patches are split for them.
struct HemicubeStyle {
  std::string name;
  radiosity::Orientation orientation;
  double split;  ///< see radiosity::DrawingSettings
  std::vector<int> measured;
};

/// A square and four halves of it.
double hemicubePixels(int resolution) { return 3.0 * resolution * resolution; }

TradeMethod hemicubeMethod(const HemicubeStyle& style) {
  const auto rows = [style](const Scene& scene, Discretization& discretization, int resolution) -> RowSource {
    const auto drawn =
        std::make_shared<radiosity::DrawnRows>(scene, discretization, radiosity::layOut(discretization),
                                               radiosity::DrawingSettings{resolution, style.orientation, style.split});
    discretization = drawn->discretization();
    return [drawn](std::uint32_t patch) { return drawn->rows().ofPatch(patch); };
  };
  const auto bytes = [](int resolution) {
    return static_cast<std::size_t>(hemicubePixels(resolution)) * sizeof(raster::Word);
  };
  return {style.name, "resolution", 2, 4096, style.measured, hemicubePixels, bytes, rows};
}

TradeMethod rayMethod(const std::string& name, RayStart start) {
  const auto rows = [start](const Scene& scene, Discretization& discretization, int rays) -> RowSource {
    const auto rayRows = std::make_shared<RayRows>(scene, discretization, RayRowSettings{rays, start});
    return [rayRows](std::uint32_t patch) { return rayRows->ofPatch(patch); };
  };
  // A direction and a place to start from.
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

std::vector<TradeMethod> tradeMethods() {
  using radiosity::Orientation;
  const std::vector<int> few{32, 64, 128, 256, 512};
  return {hemicubeMethod({"hemicube", Orientation::Aligned, 1, {32, 64, 128, 256, 512, 1024, 2048}}),
          hemicubeMethod({"turned-hemicube", Orientation::Turned, 1, few}),
          hemicubeMethod({"split-hemicube", Orientation::Turned, radiosity::defaultMostReturning, few}),
          rayMethod("centre-rays", RayStart::Centre), rayMethod("area-rays", RayStart::Area)};
}

}  // namespace hemitex::reference
