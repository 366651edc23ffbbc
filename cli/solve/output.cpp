#include "cli/solve/output.h"

#include <array>
#include <numeric>
#include <utility>

#include "cli/common/interruption.h"
#include "cli/common/json.h"
#include "cli/report/solved_page.h"
#include "cli/scene/facet_file.h"
#include "cli/solve/options.h"
#include "radiosity/bands/band_textures.h"
#include "radiosity/bands/element_table.h"
#include "radiosity/base/csv_table.h"
#include "radiosity/gather/final_gather.h"
#include "radiosity/meshes/vtu_file.h"
#include "radiosity/pictures/default_camera.h"
#include "radiosity/pictures/picture_exposure.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/surface_names.h"
#include "radiosity/textures/light_maps.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/file_io.h"

namespace hemitex::cli {
namespace {

radiosity::ElementValues displayed(const SolvedScene& solved) {
  return [&solved](std::uint32_t element) {
    return radiosity::displayRadiosity(solved.scene, solved.discretization, solved.solution, element);
  };
}

/// The picture of the lit scene in front of its sky; without textures, of the light of each element, without filtering.
radiosity::Image pictureOf(const SolvedScene& solved, const std::optional<radiosity::LitScene>& lit) {
  const int width = solved.options.camera.width, height = solved.options.camera.height;
  const double exposure = exposureOf(solved);
  const glm::dvec3 sky = radiosity::skyColour(solved.scene.outside.sky, exposure);
  if (lit) return radiosity::unlitPicture(*lit, solved.camera, width, height, sky);
  const auto colours = [&, light = displayed(solved)](std::uint32_t element) { return light(element) * exposure; };
  return radiosity::elementPicture(solved.scene, solved.discretization, colours, solved.camera, width, height, sky);
}

/// The values of the facets that scene.vtu shows. Those without area have zeros.
std::vector<radiosity::FaceArray> facetArrays(const SolvedScene& solved) {
  const std::size_t facets = solved.scene.faces;
  std::vector<double> errors(facets);
  std::array<radiosity::FaceArray, 3> ofBands{{{"radiosity", 3}, {"emission", 3}, {"reflectance", 3}}};
  for (radiosity::FaceArray& array : ofBands) array.values.resize(3 * facets);
  const std::vector<std::uint32_t> facetOf = facetsOf(solved.scene).ofSurface;
  for (std::uint32_t s = 0; s < facetOf.size(); ++s) {
    const SurfaceMeans means = meansOf(solved, s);
    for (int band = 0; band < 3; ++band) {
      const std::size_t place = 3 * std::size_t{facetOf[s]} + static_cast<std::size_t>(band);
      ofBands[0].values[place] = means.radiosity[band];
      ofBands[1].values[place] = means.emission[band];
      ofBands[2].values[place] = means.reflectance[band];
    }
    if (!solved.rowErrors.empty()) errors[facetOf[s]] = solved.rowErrors[s];
  }
  std::vector<radiosity::FaceArray> arrays(ofBands.begin(), ofBands.end());
  if (!solved.rowErrors.empty()) arrays.push_back({"row_error", 1, errors});
  return arrays;
}

radiosity::TextureLayout texturesOf(const SolvedScene& solved) {
  return radiosity::layOutTextures(solved.scene, solved.discretization, magnificationOf(solved.options));
}

/// The radiosity of each texel, gathered or that of its element.
std::vector<radiosity::Image> linearTextures(const SolvedScene& solved, const radiosity::TextureLayout& layout) {
  if (solved.gathered)
    return radiosity::radiosityTextures(solved.scene, solved.discretization, layout, *solved.gathered);
  return radiosity::radiosityTextures(solved.discretization, layout, solved.solution.radiosity);
}

std::vector<std::string> writeLightMaps(const std::filesystem::path& folder, const SolvedScene& solved,
                                        const radiosity::TextureLayout& layout, const radiosity::PictureView& view) {
  std::vector<glm::dvec3> irradiance = solved.solution.irradiance;
  for (glm::dvec3& value : irradiance) value += solved.solution.ambient;
  std::vector<radiosity::Image> linear =
      solved.gathered ? radiosity::irradianceTextures(solved.discretization, layout, *solved.gathered)
                      : radiosity::radiosityTextures(solved.discretization, layout, irradiance);
  radiosity::LightMaps maps = solved.gathered
                                  ? radiosity::makeLightMaps(solved.scene, solved.discretization,
                                                             solved.gathered->irradiance, linear, exposureOf(solved))
                                  : radiosity::makeLightMaps(solved.scene, solved.discretization, layout, irradiance,
                                                             exposureOf(solved), filterOf(solved.options));
  return radiosity::writeLightMaps(folder, std::move(maps), solved.scene, solved.discretization, layout,
                                   std::move(linear), view);
}

}  // namespace

std::set<std::string> outputNames(const SolveOptions& options, const radiosity::Scene& scene,
                                  const radiosity::Discretization& discretization, std::size_t frames) {
  std::set<std::string> names{"scene.view.json", "render.png", "solution.json", "report.html"};
  if (!options.noElements) names.insert("elements.csv");
  if (writesFacets(options)) names.insert("scene.vtu");
  if (!options.noTextures) names.insert({"scene.obj", "scene.mtl", "scene.glb"});
  if (options.lightmap) names.insert("lightmap.glb");
  if (hasTextures(options))
    for (const std::string& texture : radiosity::layOutTextures(scene, discretization, magnificationOf(options)).names)
      for (const std::string folder : {"", "lightmaps/"})
        if (folder.empty() ? !options.noTextures : options.lightmap)
          names.insert({folder + texture + ".png", folder + texture + ".exr"});
  const std::set<std::string> ofFrame = names;
  for (std::size_t f = 1; f <= frames; ++f)
    for (const std::string& name : ofFrame) names.insert("frame-" + std::to_string(f) + "/" + name);
  return names;
}

double exposureOf(const SolvedScene& solved) {
  if (solved.options.camera.exposure) return *solved.options.camera.exposure;
  return radiosity::pictureExposure(solved.scene, solved.discretization, displayed(solved), solved.camera,
                                    solved.options.camera.width, solved.options.camera.height);
}

std::optional<radiosity::GatheredLight> gatheredLight(const SolvedScene& solved, Console& console) {
  if (!solved.options.gather) return std::nullopt;
  const LongRun run;
  std::optional<radiosity::GatheredLight> light =
      radiosity::gather(solved.scene, solved.discretization, solved.layout, texturesOf(solved), solved.solution, {},
                        {[&](double done) { console.progress(done, "gathering"); }, &LongRun::isStopping()});
  console.endProgress();
  return light;
}

std::optional<radiosity::LitScene> litScene(const SolvedScene& solved) {
  if (solved.options.noTextures) return std::nullopt;
  const radiosity::TextureLayout layout = texturesOf(solved);
  if (solved.gathered)
    return radiosity::makeLitScene(solved.scene, solved.discretization, layout,
                                   radiosity::codedTextures(linearTextures(solved, layout), exposureOf(solved)));
  return radiosity::makeLitScene(solved.scene, solved.discretization, layout,
                                 radiosity::displayValues(solved.scene, solved.discretization, solved.solution),
                                 exposureOf(solved), filterOf(solved.options));
}

std::vector<std::string> writeSolved(const std::filesystem::path& folder, const SolvedScene& solved,
                                     const std::optional<radiosity::LitScene>& lit) {
  const SolveOptions& options = solved.options;
  const radiosity::PictureView view{solved.camera, static_cast<double>(options.camera.width) / options.camera.height,
                                    radiosity::upAxis(solved.scene, options.camera.upAxis),
                                    options.metresPerUnit.value_or(1)};
  std::vector<std::string> warnings;
  if (lit) warnings = radiosity::writeLitScene(folder, *lit, view, linearTextures(solved, lit->layout));
  if (lit && !solved.scene.wavelengths.empty())  // in place of the textures of the colour alone
    radiosity::writeBandTextures(folder, solved.discretization, lit->layout, solved.solution, solved.scene.wavelengths);
  if (options.lightmap)
    for (std::string& warning : writeLightMaps(folder, solved, lit ? lit->layout : texturesOf(solved), view))
      warnings.push_back(std::move(warning));
  radiosity::writePng(folder / "render.png", pictureOf(solved, lit));
  raster::writeFile(folder / "scene.view.json", toText(toJson(solved.camera)));
  if (writesFacets(options))
    radiosity::writeVtu(folder / "scene.vtu", radiosity::readFaces(options.scene.file, options.scene.settings.sides),
                        facetArrays(solved));
  if (!options.noElements)
    raster::writeFile(folder / "elements.csv", [&solved](std::ostream& stream) {
      radiosity::writeCsv(stream, radiosity::elementTable(solved.scene, solved.discretization, solved.solution));
    });
  return warnings;
}

ShownScene shownScene(const std::filesystem::path& folder, const SolvedScene& solved, radiosity::Scene lit,
                      const Convergence& convergence) {
  constexpr std::size_t maxPatches = 256;  // so that the page costs at most some hundred hemicubes
  std::vector<glm::dvec3> absorbed = solved.solution.absorbedByBacks;
  for (glm::dvec3& flux : absorbed) flux *= squareMetresPerUnit(solved.options);
  const std::size_t surfaces = solved.scene.surfaces.size();
  ShownScene shown{folder / "scene.glb",
                   std::move(lit),
                   std::vector<std::uint32_t>(surfaces),
                   convergence,
                   radiosity::backAbsorption(solved.scene, solved.discretization, solved.layout, solved.options.drawing,
                                             absorbed, maxPatches),
                   std::vector<glm::dvec3>(surfaces)};
  std::iota(shown.surfaceOf.begin(), shown.surfaceOf.end(), 0u);
  for (std::size_t p = 0; p < absorbed.size(); ++p)
    shown.lostToBacks[solved.discretization.patches.list[p].surface] += absorbed[p];
  return shown;
}

std::string filesText(const SolveOptions& options) {
  const auto line = [&options](const std::string& what, const char* file) {
    return what + (options.output / file).string() + '\n';
  };
  return '\n' + line("picture:    ", "render.png") + (options.noTextures ? "" : line("lit scene:  ", "scene.obj")) +
         (writesFacets(options) ? line("facets:     ", "scene.vtu") : "") + line("numbers:    ", "solution.json") +
         (options.report ? line("page:       ", "report.html") : "");
}

}  // namespace hemitex::cli
