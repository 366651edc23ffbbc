/// Writes the light of a scene, found by light tracing, as a table of its surfaces:
/// `hemitex_truth SCENE.obj [--texels N | --texel-size LENGTH] [--paths N] [--points N] [--seed N] [--sky R,G,B]
/// [--elements FILE.csv] -o FILE.csv`. The second table is that of its elements.
#include <chrono>
#include <cstdio>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "radiosity/discretization/discretize.h"
#include "radiosity/scene/load_scene.h"
#include "raster/base/input_error.h"
#include "tests/support/truth_table.h"
#include "tests/truth/baked_radiosity.h"

using namespace hemitex;

namespace {

struct Arguments {
  std::string scene, output, elements, command = "hemitex_truth";
  radiosity::DiscretizationSettings grid;
  tests::BakeSettings bake;
  glm::dvec3 sky{0.0};
};

glm::dvec3 bandsOf(const std::string& text) {
  glm::dvec3 bands;
  if (std::sscanf(text.c_str(), "%lf,%lf,%lf", &bands.r, &bands.g, &bands.b) != 3)
    throw std::invalid_argument(text + " is not R,G,B");
  return bands;
}

Arguments parsed(int argc, char** argv) {
  Arguments result;
  for (int i = 1; i < argc; ++i) {
    const std::string name = argv[i];
    result.command += ' ' + name;
    if (name[0] != '-') {
      result.scene = name;
      continue;
    }
    if (++i == argc) throw std::invalid_argument(name + " lacks its value");
    const std::string value = argv[i];
    result.command += ' ' + value;
    if (name == "-o")
      result.output = value;
    else if (name == "--elements")
      result.elements = value;
    else if (name == "--texels")
      result.grid.texels = std::stoi(value);
    else if (name == "--texel-size")
      result.grid.texelSize = std::stod(value);
    else if (name == "--paths")
      result.bake.paths = std::stoi(value);
    else if (name == "--points")
      result.bake.points = std::stoi(value);
    else if (name == "--seed")
      result.bake.seed = static_cast<std::uint32_t>(std::stoul(value));
    else if (name == "--sky")
      result.sky = bandsOf(value);
    else
      throw std::invalid_argument("unknown option " + name);
  }
  if (result.scene.empty() || result.output.empty())
    throw std::invalid_argument("SCENE.obj and -o FILE.csv are needed");
  return result;
}

glm::dvec3 emittedFlux(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                       const tests::BakedRadiosity& baked) {
  glm::dvec3 sum(0);
  for (std::uint32_t e = 0; e < discretization.elements.size(); ++e)
    sum += baked.exposedArea[e] * radiosity::emission(scene, discretization, e);
  return sum;
}

/// Prints the errors: of single elements, and the largest of a surface.
void printErrors(const radiosity::Scene& scene, const radiosity::Discretization& discretization,
                 const tests::BakedRadiosity& baked) {
  const auto total = [](const glm::dvec3& v) { return v.r + v.g + v.b; };
  double flux = 0, error = 0;
  for (std::size_t e = 0; e < baked.flux.size(); ++e) {
    flux += total(baked.flux[e]);
    error += total(baked.fluxError[e]);
  }
  const glm::dvec3 emitted = emittedFlux(scene, discretization, baked);
  double largest = 0;
  for (std::uint32_t s = 0; s < scene.surfaces.size(); ++s) {
    const tests::SurfaceFlux& of = baked.surfaces[s];
    for (int c = 0; c < 3; ++c)
      if (of.fluxError[c] > 0)
        largest = std::max(largest, std::min(of.fluxError[c] / of.flux[c] / 2e-3, of.fluxError[c] / emitted[c] / 2e-5));
  }
  std::printf("%zu elements; standard errors of their flux: %.3g %% of all flux in sum\n", baked.flux.size(),
              100 * error / flux);
  std::printf(
      "largest standard error of a surface: %.3g of what is wanted (0.2 %% of its flux or 0.002 %% of the emitted)\n",
      largest);
}

/// The flux of each element and its standard error, bands summed.
void writeElements(const std::string& path, const radiosity::Scene& scene,
                   const radiosity::Discretization& discretization, const tests::BakedRadiosity& baked) {
  std::ofstream file(path, std::ios::binary);
  file << "surface,column,row,flux,error\n";
  for (std::size_t e = 0; e < baked.flux.size(); ++e) {
    const radiosity::Element& element = discretization.elements[e];
    const auto columns = static_cast<std::uint32_t>(discretization.grids[element.surface].columns);
    file << scene.surfaces[element.surface].name << ',' << element.texel % columns << ',' << element.texel / columns
         << ',' << baked.flux[e].r + baked.flux[e].g + baked.flux[e].b << ','
         << baked.fluxError[e].r + baked.fluxError[e].g + baked.fluxError[e].b << '\n';
  }
}

void write(const Arguments& arguments) {
  const auto start = std::chrono::steady_clock::now();
  radiosity::Scene scene = radiosity::loadScene(arguments.scene, {.sides = radiosity::Sides::TwoOfSheets});
  scene.outside.sky = arguments.sky;
  const radiosity::Discretization discretization = radiosity::discretizeUnburied(scene, arguments.grid);
  const tests::BakedRadiosity baked = tests::bakedRadiosity(scene, discretization, arguments.bake);
  std::ofstream file(arguments.output, std::ios::binary);
  tests::writeTruthTable(file, arguments.command, scene, baked);
  file.close();
  if (!file) throw raster::InputError(arguments.output, 0, "cannot be written", "name a folder that exists");
  if (!arguments.elements.empty()) writeElements(arguments.elements, scene, discretization, baked);
  printErrors(scene, discretization, baked);
  std::printf("%.3g s\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace

int main(int argc, char** argv) {
  try {
    write(parsed(argc, argv));
  } catch (const std::exception& error) {
    std::cerr
        << "hemitex_truth: " << error.what()
        << "\nusage: hemitex_truth SCENE.obj [--texels N | --texel-size LENGTH] [--paths N] [--points N] [--seed N] "
           "[--sky R,G,B] [--elements FILE.csv] -o FILE.csv\n";
    return 2;
  }
}
