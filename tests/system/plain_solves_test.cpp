// PlainRenderer draws all item buffers of solutions of data/ like SoftwareRenderer.
#include <atomic>
#include <catch2/catch.hpp>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/base/parallel.h"
#include "raster/plain/plain_renderer.h"
#include "raster/software/software_renderer.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

struct Counts {
  std::atomic<std::size_t> buffers = 0, different = 0;
};

/// Draws with both renderers, one face per thread, and counts the item buffers that differ.
class BothRenderers final : public raster::ItemBufferRenderer {
 public:
  BothRenderers(const raster::DrawList& list, Counts& counts) : plain_(list), fast_(list), counts_(counts) {}

  void draw(std::span<const raster::Face> faces, std::span<const std::uint32_t> skipped,
            std::vector<raster::ItemBuffer>& buffers, const std::function<void(std::size_t)>& drawn) override {
    fast_.draw(faces, skipped, buffers, drawn);
    raster::parallelFor(faces.size(), [&](std::size_t f) {
      const raster::ItemBuffer plain = raster::render(plain_, faces.subspan(f, 1), skipped).front();
      ++counts_.buffers;
      if (plain.ids != buffers[f].ids) ++counts_.different;
    });
  }

 private:
  raster::PlainRenderer plain_;
  raster::SoftwareRenderer fast_;
  Counts& counts_;
};

void checkSolution(const std::string& name, std::optional<int> shots) {
  INFO(name);
  const Scene scene = loadScene(std::string(HEMITEX_DATA) + "/" + name + ".obj");
  Discretization discretization = discretize(scene, {});
  const IdLayout layout = layOut(discretization);
  Counts counts;
  SceneFormFactors drawn(scene, discretization, layout, {},
                         [&](raster::DrawList list) { return std::make_unique<BothRenderers>(list, counts); });
  solve({.scene = scene,
         .discretization = discretization,
         .patches = discretization.patches,
         .rowOf = drawn.rowOf(),
         .split = drawn.splits(),
         .settings = {.shots = shots}});
  CHECK(counts.buffers > 1000);
  CHECK(counts.different == 0);
}

}  // namespace

TEST_CASE("PlainRenderer draws the item buffers of a solution of the Cornell box", "[plain]") {
  checkSolution("cornell-box", 300);
}

// Some minutes: the target million_vectors runs it.
TEST_CASE("PlainRenderer draws all item buffers of solutions of data/", "[.million_vectors]") {
  for (const char* name : {"cornell-box", "pyramid-room", "paper-room", "furnished-room", "curved-room", "plant"})
    checkSolution(name, {});
}
