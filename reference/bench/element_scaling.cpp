#include "reference/bench/element_scaling.h"

#include <deque>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/hemicube.h"
#include "raster/software/software_renderer.h"
#include "reference/bench/equal_time_error.h"

namespace hemitex::reference {
namespace {

/// A scene at one fineness, seen from patches that are the same at all.
class Level {
 public:
  Level(const radiosity::Scene& scene, int side, int resolution)
      : discretization_(radiosity::discretize(scene, {.texels = side, .patches = 4})),
        layout_(radiosity::layOut(discretization_, {.format = "r32ui"})),
        renderer_(radiosity::makeDrawList(scene, discretization_, layout_)),
        rows_(scene, discretization_, layout_, renderer_, {.resolution = resolution}),
        faces_(radiosity::wholeFaces(rows_.projection())),
        counter_(discretization_, layout_) {
    for (const std::uint32_t patch : spreadPatches(discretization_, 3))
      views_.push_back(rows_.viewsOfPatch(patch).front());
    for (const radiosity::View& view : views_) drawn_.push_back(renderer_.render(view.faces, view.skipped));
  }
  Level(const Level&) = delete;
  Level& operator=(const Level&) = delete;

  std::size_t elements() const { return discretization_.elements.size(); }
  std::size_t hemicubes() const { return views_.size(); }

  void draw() {
    for (const radiosity::View& view : views_) renderer_.draw(view.faces, view.skipped, ids_);
  }
  void sum() {
    for (const auto& buffers : drawn_) counter_.rowOf(rows_.projection(), faces_, buffers);
  }

 private:
  radiosity::Discretization discretization_;
  radiosity::IdLayout layout_;
  raster::SoftwareRenderer renderer_;
  radiosity::ProjectedFormFactors rows_;
  std::vector<radiosity::Window> faces_;
  radiosity::ItemBufferSum counter_;
  std::vector<radiosity::View> views_;
  std::vector<std::vector<raster::ItemBuffer>> drawn_;
  std::vector<raster::ItemBuffer> ids_;
};

}  // namespace

std::vector<GrowthPoint> growthOf(const radiosity::Scene& scene, std::span<const int> sides, int resolution,
                                  int repeats) {
  std::deque<Level> levels;
  std::vector<std::function<void()>> tasks;
  for (const int side : sides) {
    Level& level = levels.emplace_back(scene, side, resolution);
    tasks.push_back([&level] { level.draw(); });
    tasks.push_back([&level] { level.sum(); });
  }
  const std::vector<Timing> timings = shortTaskTimings(tasks, repeats);
  std::vector<GrowthPoint> points;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const auto hemicubes = static_cast<double>(levels[i].hemicubes());
    points.push_back({sides[i], levels[i].elements(), timings[2 * i] / hemicubes, timings[2 * i + 1] / hemicubes});
  }
  return points;
}

}  // namespace hemitex::reference
