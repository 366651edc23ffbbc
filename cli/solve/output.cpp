#include "cli/solve/output.h"

#include <sstream>

#include "cli/common/json.h"
#include "cli/solve/solution_json.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/file_io.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

std::string chartsName(radiosity::Charts charts) {
  return charts == radiosity::Charts::Auto ? "auto" : charts == radiosity::Charts::File ? "file" : "planar";
}

std::string emissionName(radiosity::EmissionUnit unit) {
  return unit == radiosity::EmissionUnit::Radiosity ? "radiosity" : "radiance";
}

/// Only the surfaces whose texels were asked for, and these are square.
ordered_json surfaceTexelsJson(const radiosity::DiscretizationSettings& settings) {
  ordered_json texels = ordered_json::object();
  for (const auto& [name, size] : settings.surfaceTexels) texels[name] = size.columns;
  return texels;
}

/// The settings that the answer depends on: no path, no thread count.
ordered_json settingsJson(const Showing& showing) {
  const SolveOptions& options = showing.options;
  const radiosity::TextureSettings textures = texturesOf(options);
  const auto orNull = [](const auto& value) { return value ? ordered_json(*value) : ordered_json(); };
  const auto ofProjections = [&](const auto& value) {
    return usesRays(options) ? ordered_json() : ordered_json(value);
  };
  return {{"charts", chartsName(options.scene.settings.charts)},
          {"max_reflectance", options.scene.settings.maxReflectance},
          {"two_sided", options.scene.settings.twoSided},
          {"emission", emissionName(options.scene.settings.emission)},
          {"texels", orNull(options.discretization.texels)},
          {"texel_size", orNull(options.discretization.texelSize)},
          {"surface_texels", surfaceTexelsJson(options.discretization)},
          {"patch", options.discretization.patches ? ordered_json() : ordered_json(options.discretization.patch)},
          {"patches", orNull(options.discretization.patches)},
          {"adaptive", orNull(options.adaptive)},
          {"discretize", ofProjections(nameOf(options.drawing.elementsBy))},
          {"method", options.method},
          {"resolution", ofProjections(options.drawing.resolution)},
          {"orientation", ofProjections(nameOf(options.drawing.orientation))},
          {"split", options.drawing.split},
          {"pixels_per_element", ofProjections(options.drawing.pixelsPerElement)},
          {"samples", usesRays(options) ? ordered_json(options.samples) : ordered_json()},
          {"format", options.id.format},
          {"index_maps", nameOf(options.id.indexMaps)},
          {"page", orNull(options.id.page)},
          {"blend", options.id.blend == raster::Blend::ClampedAdd ? "clamped-add" : "integer-add"},
          {"align", options.id.aligned},
          {"max_error", orNull(options.maxError)},
          {"residual", options.solver.shots ? ordered_json() : ordered_json(options.solver.residual)},
          {"shots", orNull(options.solver.shots)},
          {"filter", nameOf(textures.filter)},
          {"magnify", textures.magnification},
          {"camera", toJson(showing.camera)},
          {"size", {options.camera.width, options.camera.height}},
          {"exposure", showing.exposure}};
}

}  // namespace

double exposureOf(const SolveOptions& options, const Lit& lit) {
  return options.camera.exposure.value_or(radiosity::defaultExposure(
      lit.scene, lit.discretization, radiosity::displayRadiosity(lit.scene, lit.discretization, lit.solution)));
}

void writeSolved(const std::filesystem::path& folder, const Lit& lit, const Showing& showing) {
  const SolveOptions& options = showing.options;
  radiosity::writeLitScene(folder, lit.scene, lit.discretization, lit.solution, showing.exposure, texturesOf(options));
  // The picture shows what is in the folder: the textures that any viewer shows.
  const radiosity::Scene shown = radiosity::loadScene(folder / "scene.obj");
  radiosity::writePng(folder / "render.png",
                      radiosity::unlitPicture(shown, showing.camera, options.camera.width, options.camera.height));
  raster::writeFile(folder / "scene.view.json", toText(toJson(showing.camera)));
  std::ostringstream elements;
  writeCsv(elements, elementTable(lit.scene, lit.discretization, lit.solution));
  raster::writeFile(folder / "elements.csv", elements.view());
}

ordered_json description(const Lit& lit, const Showing& showing) {
  ordered_json text = {{"settings", settingsJson(showing)}};
  text.update(describe(lit.scene, lit.discretization, lit.layout, lit.solution));
  return text;
}

std::string summary(const ordered_json& solution) {
  std::ostringstream text;
  text << solution["surfaces"].size() << " surfaces, " << solution["elements"] << " elements, " << solution["patches"]
       << " patches, " << solution["phantoms"] << " phantom indices\n"
       << solution["shots"] << " shots, residual " << solution["residual"] << '\n';
  if (solution.contains("frames"))
    for (const ordered_json& frame : solution["frames"])
      text << frame["folder"].get<std::string>() << ": " << frame["shots"] << " shots, residual " << frame["residual"]
           << '\n';
  if (solution.contains("expected_error")) text << "expected error " << solution["expected_error"] << '\n';
  for (const auto& [name, flux] : solution["energy"].items()) text << name << ' ' << flux.dump() << '\n';
  return text.str();
}

}  // namespace hemitex::cli
