#include "reference/measurement/bench/exact_fallback_cost.h"

#include "raster/software/software_renderer.h"
#include "reference/conformance/vectors/draw_list_builder.h"

namespace hemitex::reference {

raster::DrawList tiedWall(int resolution, double moved) {
  raster::DrawList list = plainList();
  list.indexMaps.push_back(countingMap(resolution, resolution));
  addDraw(list, 0x10000, {}, 0);
  const double first = moved, end = resolution + moved;
  const glm::vec3 a = pixelPoint(resolution, {first, first}), b = pixelPoint(resolution, {end, first});
  const glm::vec3 c = pixelPoint(resolution, {end, end}), d = pixelPoint(resolution, {first, end});
  const float low = -0.5f / static_cast<float>(resolution), high = 1 + low;
  addTriangle(list, {a, c, b}, {{low, low}, {high, high}, {high, low}});
  addTriangle(list, {a, d, c}, {{low, low}, {low, high}, {high, high}});
  return list;
}

WallTimes wallTimes(int resolution, int repeats) {
  raster::SoftwareRenderer tied(tiedWall(resolution, 0)), moved(tiedWall(resolution, 1.0 / 3));
  const raster::Face face = frontFace(resolution, 0.5f);
  std::vector<raster::ItemBuffer> buffers;
  const auto draw = [&](raster::SoftwareRenderer& wall) {
    return [&] { raster::draw(wall, {&face, 1}, {}, buffers); };
  };
  const std::vector<std::function<void()>> tasks{draw(tied), draw(moved)};
  const std::vector<Timing> timings = shortTaskTimings(tasks, repeats);
  return {resolution, timings[0], timings[1]};
}

}  // namespace hemitex::reference
