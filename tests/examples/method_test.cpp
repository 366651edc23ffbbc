// examples/method.cpp: its radiosity is that of hemitex.
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/projected_form_factors.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/solver/progressive_solver.h"
#include "raster/software/software_renderer.h"
#include "tests/support/temporary_folder.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// The columns b_r, b_g, b_b of the program's table.
std::vector<glm::dvec3> radiosityIn(const std::filesystem::path& file) {
  std::ifstream table(file);
  std::vector<glm::dvec3> radiosity;
  std::string line;
  std::getline(table, line);
  while (std::getline(table, line)) {
    std::string surface;
    char comma;
    int column, row;
    glm::dvec3 b;
    std::istringstream fields(line);
    std::getline(fields, surface, ',');
    fields >> column >> comma >> row >> comma >> b.x >> comma >> b.y >> comma >> b.z;
    REQUIRE(fields);
    radiosity.push_back(b);
  }
  return radiosity;
}

}  // namespace

// The program sums form factors in double precision, pixel by pixel, and hemitex in units of 2^-60. So both differ by
// rounding errors: an element is the sum of some 600 shots, each the sum of some hundred pixels.
TEST_CASE("The radiosity of examples/method.cpp equals that of solve with the same patches", "[examples]") {
  const TemporaryFolder folder;
  REQUIRE(std::system((HEMITEX_EXAMPLES "/hemitex_method " + folder.path.string()).c_str()) == 0);
  const std::vector<glm::dvec3> found = radiosityIn(folder.path / "radiosity.csv");

  const Scene scene = loadScene(folder.path / "scene.obj");
  DiscretizationSettings settings{.texels = 1, .isUnburied = true, .patch = 4};
  for (const Surface& surface : scene.surfaces) settings.surfaceTexels[surface.name] = {12, 8};
  const Discretization discretization = discretize(scene, settings);
  const IdLayout layout = layOut(discretization);
  raster::SoftwareRenderer renderer(makeDrawList(scene, discretization, layout));
  ProjectedFormFactors rows(scene, discretization, layout, renderer, {.resolution = 256});
  const Solution solution =
      solve({.scene = scene, .discretization = discretization, .patches = discretization.patches, .rowOf = [&](const Patch& patch) { return rows.ofPatch(patch); }, .settings = {.residual = 0.001}});

  REQUIRE(found.size() == solution.radiosity.size());
  double largest = 0;
  for (std::size_t e = 0; e < found.size(); ++e)
    for (int band = 0; band < 3; ++band)
      largest = std::max(largest, std::abs(found[e][band] - solution.radiosity[e][band]) / solution.radiosity[e][band]);
  CHECK(largest <= 1e-12);
}
