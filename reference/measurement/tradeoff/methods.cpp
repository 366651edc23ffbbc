#include "reference/measurement/tradeoff/methods.h"

#include "radiosity/form_factors/level_of_detail.h"
#include "reference/rows/solution_rows.h"

namespace hemitex::reference {
namespace {

constexpr double unsplit = 1;

/// Pixels of all faces of a projection; a hemicube has one square face and four halves.
double pixelsOf(radiosity::ProjectionKind projection, int resolution) {
  return (projection == radiosity::ProjectionKind::SinglePlane ? 1.0 : 3.0) * resolution * resolution;
}

/// Pixels with a delta form factor above 0; for a cubic tetrahedron these are half of each face and its diagonal.
double directionsOf(radiosity::ProjectionKind projection, int resolution) {
  const double pixels = pixelsOf(projection, resolution);
  return projection == radiosity::ProjectionKind::CubicTetrahedron ? (pixels + 3.0 * resolution) / 2 : pixels;
}

/// A method that draws; its setting is the resolution.
TradeMethod drawnMethod(const std::string& name, const radiosity::DrawingSettings& style,
                        const std::vector<int>& measured = {32, 64, 128, 256, 512}) {
  const auto rows = [style](int resolution) -> TradeRows {
    radiosity::DrawingSettings settings = style;
    settings.resolution = resolution;
    return {settings};
  };
  const auto directions = [style](int resolution) { return directionsOf(style.projection, resolution); };
  const auto bytes = [style](int resolution) {
    return static_cast<std::size_t>(pixelsOf(style.projection, resolution)) * sizeof(raster::ItemId);
  };
  return {name, "resolution", 2, 4096, measured, directions, bytes, rows};
}

TradeMethod rayMethod(const std::string& name, RayStart start, std::uint32_t seed) {
  const auto rows = [start, seed](int rays) -> TradeRows {
    return {.drawing = {.split = unsplit}, .others = rayRows({rays, start, seed})};
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
  using radiosity::ProjectionKind;
  return {drawnMethod("hemicube", {.orientation = radiosity::Orientation::Aligned, .split = unsplit},
                      {32, 64, 128, 256, 512, 1024, 2048}),
          drawnMethod("turned-hemicube", {.split = unsplit}),
          drawnMethod("split-hemicube", {}),
          drawnMethod("single-plane", {.split = unsplit, .projection = ProjectionKind::SinglePlane}),
          drawnMethod("tetrahedron", {.split = unsplit, .projection = ProjectionKind::CubicTetrahedron}),
          drawnMethod("levels-of-detail", {.split = unsplit, .pixelsPerElement = radiosity::suggestedPixelsPerElement}),
          rayMethod("centre-rays", RayStart::Centre, seed),
          rayMethod("area-rays", RayStart::Area, seed)};
}

}  // namespace hemitex::reference
