/// Lights a room made of arrays: from rectangles to radiosity and a picture.
///
///     light_a_room PICTURE.png
#include <array>
#include <iostream>
#include <string>

#include "radiosity/discretization/discretize.h"
#include "radiosity/images/image.h"
#include "radiosity/light/light.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/scene/scene.h"

using namespace hemitex::radiosity;

namespace {

/// A surface of two triangles, lit on the side from which its corners run counter-clockwise. Its chart, which the
/// elements divide, is the whole unit square.
Surface rectangle(const std::string& name, int material, const std::array<glm::dvec3, 4>& corner) {
  const std::array<glm::dvec2, 4> chart{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
  Surface surface{.name = name, .family = name, .material = material, .triangles = {}};
  for (const std::array<std::size_t, 3>& k : {std::array<std::size_t, 3>{0, 1, 2}, {0, 2, 3}})
    surface.triangles.push_back({{corner[k[0]], corner[k[1]], corner[k[2]]},
                                 {chart[k[0]], chart[k[1]], chart[k[2]]},
                                 {chart[k[0]], chart[k[1]], chart[k[2]]}});
  return surface;
}

/// A room of 4 x 3 x 3 m without a front, whose left wall is a window.
Scene room() {
  Scene scene;
  scene.materials = {{.name = "grey", .reflectance = glm::dvec3(0.6)},
                     {.name = "red", .reflectance = {0.6, 0.1, 0.1}},
                     {.name = "window", .reflectance = glm::dvec3(0.1), .emission = {8, 9, 10}}};
  scene.surfaces = {rectangle("floor", 0, {{{0, 0, 3}, {4, 0, 3}, {4, 0, 0}, {0, 0, 0}}}),
                    rectangle("ceiling", 0, {{{0, 3, 0}, {4, 3, 0}, {4, 3, 3}, {0, 3, 3}}}),
                    rectangle("wall-back", 0, {{{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}}}),
                    rectangle("wall-right", 1, {{{4, 0, 0}, {4, 0, 3}, {4, 3, 3}, {4, 3, 0}}}),
                    rectangle("window", 2, {{{0, 0, 3}, {0, 0, 0}, {0, 3, 0}, {0, 3, 3}}})};
  measureBounds(scene);
  return scene;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: light_a_room PICTURE.png\n";
    return 2;
  }
  const Scene scene = room();
  const Discretization elements = discretize(scene, {.texels = 32});
  const Solution solution = light(scene, elements).solution;
  std::cout << solution.shots << " shots\n";
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const Grid& grid = elements.grids[s];
    const glm::dvec3& middle = solution.radiosity[grid.firstElement + grid.elementCount / 2 + 16];
    std::cout << scene.surfaces[s].name << ": " << middle.x << ' ' << middle.y << ' ' << middle.z << " W/m^2\n";
  }
  const Camera camera{.eye = {2, 1.5, 8}, .lookAt = {2, 1.5, 0}, .up = {0, 1, 0}, .fov = 36};
  const ElementValues shown = [&](std::uint32_t element) { return 0.2 * solution.radiosity[element]; };
  writePng(argv[1], elementPicture(scene, elements, shown, camera, 640, 480));
}
