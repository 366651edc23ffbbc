/// The error and the time of light from the sky (radiosity/form_factors/outside_flux.h) against rays of Embree, and of
/// the alternative: the share of the background in the hemicube of each element. Usage: hemitex_sky_errors SCENE.obj
/// [SURFACE to remove...]. Prints one line per setting: the sum of the flux errors of elements over their flux, and the
/// processor time. Elements that touch the inside of a wall are left out: rays start on the wall's other side. Of many
/// elements, only some are compared.
#include <cmath>
#include <cstdio>
#include <ctime>
#include <numeric>
#include <string>
#include <vector>

#include "radiosity/discretization/discretize.h"
#include "radiosity/form_factors/outside_flux.h"
#include "radiosity/form_factors/scene_form_factors.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/scene_edits.h"
#include "reference/truth/rays/monte_carlo_form_factors.h"

using namespace hemitex;

namespace {

constexpr int rays = 1 << 14;
constexpr std::size_t maxCompared = 1 << 14;

struct World {
  radiosity::Scene scene;
  radiosity::Discretization discretization;
  radiosity::IdLayout layout;

  explicit World(radiosity::Scene given)
      : scene(std::move(given)),
        discretization(radiosity::discretize(scene, {.patch = 1})),
        layout(radiosity::layOut(discretization)) {}
};

double secondsSince(std::clock_t start) { return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC; }

/// The flux per element from a sky of irradiance 1, by rays; 0 for elements that are not compared.
std::vector<double> trueFlux(const World& world) {
  const reference::RayFormFactors factors(world.scene, world.discretization);
  const reference::Receivers elements = reference::everyElement(world.discretization);
  std::vector<double> flux(world.discretization.elements.size());
  const std::size_t step = (flux.size() + maxCompared - 1) / maxCompared;
  for (std::size_t e = 0; e < flux.size(); e += step) {
    const std::vector<std::uint32_t> own{static_cast<std::uint32_t>(e)};
    const reference::MeasuredRow row =
        factors.overHemisphere(reference::areaRaySource(factors.pieces(), own), elements, {.samples = rays});
    flux[e] = row.background.value * world.discretization.elements[e].area;
  }
  return flux;
}

/// Sets the flux of elements to 0 that see nothing but the sky, although views of the scene do not show them.
void leaveOutCovered(const World& world, std::vector<double>& truth) {
  const auto renderer =
      radiosity::sceneRenderer(world.scene, world.discretization, world.layout, radiosity::ElementsBy::Texture);
  const radiosity::OutsideFlux found = radiosity::outsideFlux(world.scene, world.discretization, world.layout,
                                                              *renderer, {.directions = radiosity::minDirections});
  for (std::size_t e = 0; e < truth.size(); ++e)
    if (found.received[e][0] == 0 && truth[e] > 0.99 * world.discretization.elements[e].area) truth[e] = 0;
}

double errorOf(const std::vector<double>& flux, const std::vector<double>& truth) {
  double error = 0;
  for (std::size_t e = 0; e < flux.size(); ++e)
    if (truth[e] > 0) error += std::abs(flux[e] - truth[e]);
  return error / std::accumulate(truth.begin(), truth.end(), 0.0);
}

void print(const char* what, int setting, double pixels, const std::vector<double>& flux,
           const std::vector<double>& truth, double seconds) {
  std::printf("%-12s %5d  %6.1f pixels  error %.3f %%  %.2f s\n", what, setting, pixels, 100 * errorOf(flux, truth),
              seconds);
}

void measureBeams(const World& world, const std::vector<double>& truth) {
  std::vector<radiosity::OutsideViews> settings;
  for (const int directions : {128, 256, 512, 1024, 2048}) settings.push_back({.directions = directions});
  settings.push_back(radiosity::affordableViews(2048, radiosity::triangleCount(world.scene)));
  for (const radiosity::OutsideViews& views : settings) {
    const std::clock_t start = std::clock();
    const auto renderer =
        radiosity::sceneRenderer(world.scene, world.discretization, world.layout, radiosity::ElementsBy::Texture);
    const radiosity::OutsideFlux found =
        radiosity::outsideFlux(world.scene, world.discretization, world.layout, *renderer, views);
    const double seconds = secondsSince(start);
    std::vector<double> flux;
    for (std::size_t e = 0; e < found.received.size(); ++e) flux.push_back(found.received[e][0]);
    print("directions", views.directions, views.pixelsPerElement, flux, truth, seconds);
  }
}

void measureRows(const World& world, const std::vector<double>& truth) {
  for (const int resolution : {16, 32, 64, 128}) {
    const std::clock_t start = std::clock();
    radiosity::SceneFormFactors drawn(world.scene, world.discretization, world.layout,
                                      {.resolution = resolution, .split = 1});
    std::vector<double> flux(truth.size());
    for (const radiosity::Patch& patch : world.discretization.patches.list) {
      const std::uint32_t e = patch.elements.front();
      if (!(truth[e] > 0)) continue;
      flux[e] =
          radiosity::formFactor(drawn.uncorrected().ofPatch(patch).background) * world.discretization.elements[e].area;
    }
    print("hemicubes", resolution, 0, flux, truth, secondsSince(start));
  }
}

}  // namespace

int main(int count, char** arguments) {
  radiosity::Scene scene = radiosity::loadScene(arguments[1]);
  for (int i = 2; i < count; ++i)
    scene = radiosity::edited(std::move(scene), {}, {{radiosity::Edit(radiosity::Remove{arguments[i]})}}).scene;
  scene.outside.sky = glm::dvec3(1);
  const World world(std::move(scene));
  std::vector<double> truth = trueFlux(world);
  leaveOutCovered(world, truth);
  std::printf("%s: %zu elements\n", arguments[1], truth.size());
  measureBeams(world, truth);
  measureRows(world, truth);
}
