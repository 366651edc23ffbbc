/// Random boxes on a lattice in a white furnace, where radiosity is 1 on all that is exposed: whether each surface has
/// its exposed area, whether backs absorb light, and how far radiosity is from 1 (tests/support/lattice_boxes.h).
/// Usage: hemitex_lattice_furnace [FIRST_SEED] [COUNT]. Prints the scenes that miss a bound, and the worst of all.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "radiosity/discretization/discretize.h"
#include "radiosity/light/light.h"
#include "tests/support/lattice_boxes.h"

using namespace hemitex;
using namespace hemitex::radiosity;

namespace {

/// How far a scene is from the truth.
struct Miss {
  double area = 0;     ///< in squares of the lattice, of a surface
  double lost = 0;     ///< of the emitted flux, to backs
  double mean = 0;     ///< of the radiosity of a surface
  double element = 0;  ///< of the radiosity of an element

  void include(const Miss& other) {
    area = std::max(area, other.area);
    lost = std::max(lost, other.lost);
    mean = std::max(mean, other.mean);
    element = std::max(element, other.element);
  }
  bool isWithinBounds() const { return area <= 1e-4 && lost <= 1e-4 && mean <= 0.01; }
};

Miss missOf(const tests::LatticeBoxes& boxes) {
  const Scene scene = boxes.text.load({}, tests::furnaceMaterial);
  const Discretization discretization = discretize(scene, {.texelSize = 0.4});
  const Light light =
      radiosity::light(scene, discretization, {.drawing = {.resolution = 128}, .solver = {.residual = 1e-3}});
  std::map<std::string, double> area, flux;
  Miss miss{.lost = light.solution.energy.lostToBacks[0] / light.solution.energy.emitted[0]};
  for (std::size_t e = 0; e < light.discretization.elements.size(); ++e) {
    const Element& element = light.discretization.elements[e];
    if (light.discretization.grids[element.surface].isDark) continue;
    const std::string& name = scene.surfaces[element.surface].family;
    area[name] += element.area;
    flux[name] += element.area * light.solution.radiosity[e].x;
    miss.element = std::max(miss.element, std::abs(light.solution.radiosity[e].x - 1));
  }
  for (const auto& [name, exposed] : boxes.exposed) {
    miss.area = std::max(miss.area, std::abs(area[name] - exposed));
    if (area[name] > 0) miss.mean = std::max(miss.mean, std::abs(flux[name] / area[name] - 1));
  }
  return miss;
}

}  // namespace

int main(int count, char** arguments) {
  const unsigned first = count > 1 ? static_cast<unsigned>(std::atoi(arguments[1])) : 1;
  const unsigned scenes = count > 2 ? static_cast<unsigned>(std::atoi(arguments[2])) : 1000;
  Miss worst;
  unsigned missed = 0;
  const auto print = [](const std::string& what, const Miss& miss) {
    std::printf("%s: area %.2g, lost to backs %.2g, mean of a surface %.4f, element %.3f\n", what.c_str(), miss.area,
                miss.lost, miss.mean, miss.element);
    std::fflush(stdout);
  };
  for (unsigned seed = first; seed < first + scenes; ++seed) {
    const Miss miss = missOf(tests::latticeBoxes(seed));
    worst.include(miss);
    if (miss.isWithinBounds()) continue;
    ++missed;
    print("seed " + std::to_string(seed), miss);
  }
  print(std::to_string(missed) + " of " + std::to_string(scenes) + " scenes miss a bound; the worst", worst);
}
