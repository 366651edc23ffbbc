#include "cli/solve/solution_json.h"

#include <algorithm>
#include <iomanip>
#include <sstream>

#include "cli/common/json.h"
#include "cli/common/numbers.h"
#include "cli/solve/options.h"
#include "radiosity/gather/final_gather.h"
#include "radiosity/index_maps/phantom_indices.h"
#include "radiosity/textures/lit_scene.h"
#include "reference/base/hashes/sha256.h"

namespace hemitex::cli {

using nlohmann::ordered_json;

namespace {

/// The names of open sheets with two sides; none if all surfaces have two.
ordered_json sheetsJson(const radiosity::Scene& scene) {
  ordered_json names = ordered_json::array();
  const auto hasTwin = [](const radiosity::Surface& surface) { return surface.twin.has_value(); };
  if (std::all_of(scene.surfaces.begin(), scene.surfaces.end(), hasTwin)) return names;
  for (std::size_t s = 0; s < scene.surfaces.size(); ++s) {
    const radiosity::Surface& surface = scene.surfaces[s];
    const bool isFront = surface.twin && static_cast<std::size_t>(*surface.twin) > s;
    if (isFront && (names.empty() || names.back() != surface.family)) names.push_back(surface.family);
  }
  return names;
}

/// A line that counts the sheets and names some.
std::string sheetsText(const ordered_json& sheets) {
  constexpr std::size_t maxNames = 5;
  std::string text =
      std::to_string(sheets.size()) + (sheets.size() == 1 ? " open sheet has" : " open sheets have") + " two sides: ";
  for (std::size_t i = 0; i < std::min(sheets.size(), maxNames); ++i)
    text += (i == 0 ? "" : ", ") + sheets[i].get<std::string>();
  return text + (sheets.size() > maxNames ? ", ...\n" : "\n");
}

}  // namespace

SurfaceMeans meansOf(const SolvedScene& solved, std::uint32_t surface) {
  const radiosity::SurfaceValues reflectance = reflectances(solved.scene, solved.discretization, surface),
                                 emission = emissions(solved.scene, solved.discretization, surface);
  SurfaceMeans means;
  for (const std::uint32_t e : radiosity::elementsOf(solved.discretization.grids[surface])) {
    const double area = solved.discretization.elements[e].area;
    means.area += area;
    means.radiosity += solved.solution.radiosity[e] * area;
    means.reflectance += reflectance.of(e) * area;
    means.emission += emission.of(e) * area;
  }
  if (means.area > 0)
    for (glm::dvec3* mean : {&means.radiosity, &means.reflectance, &means.emission}) *mean /= means.area;
  return means;
}

namespace {

/// Number of texels completely inside solids.
std::uint64_t buriedTexels(const radiosity::Discretization& discretization) {
  std::uint64_t buried = 0;
  for (const radiosity::Grid& grid : discretization.grids) buried += grid.buried;
  return buried;
}

/// The texture of a surface and its place there.
ordered_json placeJson(const radiosity::TextureLayout& textures, std::uint32_t surface) {
  const radiosity::TexturePlace& place = textures.places[surface];
  const auto texture = static_cast<std::size_t>(place.texture);
  const radiosity::TextureLayout::Size& size = textures.textures[texture];
  return {{"name", textures.names[texture]}, {"width", size.width}, {"height", size.height},
          {"column", place.column},          {"row", place.row},    {"magnification", size.magnification}};
}

ordered_json surfacesJson(const SolvedScene& solved, const std::optional<radiosity::LitScene>& lit) {
  const std::vector<radiosity::Grid>& grids = solved.discretization.grids;
  const auto patches = radiosity::patchesOfSurfaces(solved.discretization.patches, grids.size());
  ordered_json surfaces = ordered_json::array();
  for (std::uint32_t s = 0; s < solved.scene.surfaces.size(); ++s) {
    const SurfaceMeans means = meansOf(solved, s);
    surfaces.push_back({{"name", solved.scene.surfaces[s].name},
                        {"triangles", solved.scene.surfaces[s].triangles.size()},
                        {"columns", grids[s].columns},
                        {"rows", grids[s].rows},
                        {"elements", grids[s].elementCount},
                        {"patches", patches[s].size()},
                        {"area", means.area},
                        {"radiosity", toJson(means.radiosity)},
                        {"reflectance", toJson(means.reflectance)},
                        {"emission", toJson(means.emission)},
                        {"texture", lit ? placeJson(lit->layout, s) : ordered_json()}});
    if (solved.scene.surfaces[s].curvedPart) surfaces.back()["curved"] = true;
    if (radiosity::hasMaps(solved.scene, solved.scene.surfaces[s])) surfaces.back()["maps"] = true;
  }
  return surfaces;
}

/// Values per band: of R, G and B, or by ascending wavelengths.
radiosity::Bands listed(const radiosity::Scene& scene, radiosity::Bands values) {
  if (!scene.wavelengths.empty()) std::ranges::reverse(values);
  return values;
}

/// Fluxes in W: a list per flux, with one value per band. `squareMetres` is the area of a square unit.
ordered_json energyJson(const SolvedScene& solved, bool isLitFromOutside, double squareMetres) {
  const radiosity::Energy& energy = solved.solution.energy;
  const auto watts = [&](const radiosity::Bands& flux) {
    return listed(solved.scene, radiosity::scaled(flux, squareMetres));
  };
  ordered_json text = {{"emitted", watts(energy.emitted)},
                       {"absorbed", watts(energy.absorbed)},
                       {"unshot", watts(energy.unshot)},
                       {"lost", watts(energy.lost)},
                       {"lost_to_backs", watts(energy.lostToBacks)}};
  if (isLitFromOutside) text["sky_on_backs"] = watts(energy.skyOnBacks);
  return text;
}

std::string shotsText(const ordered_json& solution, double seconds) {
  return std::to_string(solution["shots"].get<int>()) + " shots in " + roundedText(seconds) + " s, " +
         percentText(solution["residual"]) + " of the emitted flux unshot" +
         (solution.value("ended_by", "") == "shots" ? ", where --shots ended it\n" : "\n");
}

/// Empty without --max-error.
std::string expectedErrorText(const ordered_json& solution) {
  if (solution["expected_error"].is_null()) return "";
  return "expected error: " + percentText(solution["expected_error"]) + " of all flux\n                " +
         percentText(solution["expected_error_seen"]) + " of the flux of the surfaces that the camera sees\n";
}

std::string titleOf(const std::string& flux) {
  if (flux == "lost_to_backs") return "  to backs";
  return flux == "sky_on_backs" ? "sky on backs" : flux;
}

double sumOf(const ordered_json& bands) {
  double sum = 0;
  for (const ordered_json& band : bands) sum += band.get<double>();
  return sum;
}

/// The unit for fluxes up to `flux` W, so that they have few digits before and behind the point.
struct FluxUnit {
  const char* name;
  double watts;
};

FluxUnit fluxUnitFor(double flux) {
  if (flux >= 1e7) return {"MW", 1e6};
  if (flux >= 1e4) return {"kW", 1e3};
  return flux > 0 && flux < 0.1 ? FluxUnit{"mW", 1e-3} : FluxUnit{"W", 1};
}

/// One line per kind of flux: in each of R, G and B, or in all bands of wavelengths, and the share of the emitted flux,
/// summed over bands.
std::string fluxText(const ordered_json& energy, bool areWavelengths) {
  const double emitted = sumOf(energy["emitted"]);
  const FluxUnit unit = fluxUnitFor(emitted);
  std::ostringstream text;
  text << '\n' << std::left << std::setw(16) << "flux in " + std::string(unit.name) << std::right;
  const std::vector<std::string> titles =
      areWavelengths ? std::vector<std::string>{"all bands"} : std::vector<std::string>{"red", "green", "blue"};
  for (const std::string& title : titles) text << std::setw(12) << title;
  text << std::setw(12) << "of emitted";
  for (const auto& [name, bands] : energy.items()) {
    text << '\n' << std::left << std::setw(16) << titleOf(name) << std::right;
    for (const ordered_json& flux : areWavelengths ? ordered_json{sumOf(bands)} : bands)
      text << std::setw(12) << roundedText(flux.get<double>() / unit.watts);
    text << std::setw(12) << (emitted > 0 ? percentText(sumOf(bands) / emitted) : "-");
  }
  text << '\n';
  return text.str();
}

/// What was gathered, with the error between drawn texels.
std::string gatherText(const ordered_json& solution) {
  const auto gather = solution.find("gather");
  if (gather == solution.end()) return "";
  std::ostringstream text;
  text << (*gather)["drawn"] << " of " << (*gather)["texels"] << " texels gathered their light; between them the rms "
       << "error is " << percentText((*gather)["error"]) << '\n';
  return text.str();
}

/// The unit of lengths, if the options or the scene state it.
std::string unitText(const ordered_json& settings) {
  const auto metres = settings.find("metres_per_unit");
  return metres == settings.end() ? "" : "lengths are in units of " + roundedText(*metres) + " m\n";
}

/// How the emission of materials was read; empty for light from outside only.
std::string emissionText(const ordered_json& solution) {
  const auto emits = [](const ordered_json& surface) { return sumOf(surface["emission"]) > 0; };
  if (std::none_of(solution["surfaces"].begin(), solution["surfaces"].end(), emits)) return "";
  return solution["settings"]["emission"] == "radiance"
             ? "emission was read as radiance, in W/(m^2 sr)\n"
             : "emission was read as radiosity, in W/m^2; --emission radiance is for files that state radiance, "
               "as Blender does\n";
}

/// How the lights of a file were read; empty without them.
std::string candelaText(const ordered_json& settings) {
  if (!settings.contains("lumens_per_watt")) return "";
  return "candela and lux of the file were divided by " + roundedText(settings["lumens_per_watt"]) +
         " lm/W; --lumens-per-watt 1 takes their numbers as W/sr and W/m^2\n";
}

/// What was given beside --max-error and limits what it chooses.
ordered_json besideBound(const SolveOptions& options) {
  ordered_json text = ordered_json::object();
  if (options.residual) text["max_residual"] = *options.residual;
  if (options.coarsest.resolution > 0) text["min_resolution"] = options.coarsest.resolution;
  if (options.coarsest.split < 1) text["max_split"] = options.coarsest.split;
  return text;
}

}  // namespace

ordered_json solutionSettings(const SolveOptions& options) {
  ordered_json drawing = toJson(options.drawing), rays = {{"samples", options.samples}, {"seed", options.seed}};
  for (const auto& [key, value] : (usesRays(options) ? drawing : rays).items())
    if (key != "split") value = nullptr;  // patches are split by hemicubes for all methods
  ordered_json settings = toJson(options.scene.settings);
  settings.update(toJson(options.discretization));
  settings.update({{"adaptive", orNull(options.adaptive)}, {"discretize", nullptr}, {"method", options.method}});
  settings.update(drawing);
  settings.update(rays);
  settings.update(toJson(options.id));
  settings.update({{"max_error", orNull(options.maxError)},
                   {"residual", options.solver.residual},
                   {"shots", orNull(options.solver.shots)}});
  if (options.maxError) settings.update(besideBound(options));
  if (!options.bands.empty()) settings["bands"] = reference::sha256OfFile(options.bands);
  if (options.device.device != Device::Software)
    settings["device"] = deviceName(options.device.device, options.device.name);
  if (!options.matrix.empty()) settings["matrix"] = reference::sha256OfFile(options.matrix);
  return settings;
}

ordered_json description(const SolvedScene& solved, const std::optional<radiosity::LitScene>& lit) {
  const SolveOptions& options = solved.options;
  ordered_json settings = solutionSettings(options);
  const bool isFiltered = hasTextures(options) && !solved.gathered;
  settings.update({{"filter", isFiltered ? ordered_json(nameOf(filterOf(options))) : ordered_json()},
                   {"magnify", orNull(options.magnification)},
                   {"camera", toJson(solved.camera)},
                   {"size", {options.camera.width, options.camera.height}},
                   {"exposure", orNull(options.camera.exposure)}});
  if (options.metresPerUnit) settings["metres_per_unit"] = *options.metresPerUnit;
  const MaterialOptions& materials = options.scene.materials;
  if (materials.changeMaterials()) settings["materials"] = toJson(materials);
  settings.update(lightsJson(solved.scene));
  if (solved.scene.photometricLights > 0) settings["lumens_per_watt"] = options.scene.settings.lumensPerWatt;
  const radiosity::Phantoms phantoms = radiosity::countPhantoms(solved.discretization, solved.layout);
  const bool isLitFromOutside = radiosity::brightest(solved.scene.outside) > 0;
  const double squareMetres = squareMetresPerUnit(options);
  ordered_json text = {
      {"scene", options.scene.file.filename().string()},
      {"settings", settings},
      {"surfaces", surfacesJson(solved, lit)},
      {"sheets", sheetsJson(solved.scene)},
      {"elements", solved.discretization.elements.size()},
      {"patches", solved.discretization.patches.list.size()},
      {"phantoms", phantoms.spareTexels + phantoms.alignmentGaps},
      {"buried", buriedTexels(solved.discretization)},
      {"phantom_causes", {{"spare_texels", phantoms.spareTexels}, {"alignment_gaps", phantoms.alignmentGaps}}},
      {"index_bits", solved.layout.indexBits},
      {"shots", solved.solution.shots},
      {"residual", solved.solution.residual},
      {"ended_by", endOf(solved.solution, options.solver)},
      {"energy", energyJson(solved, isLitFromOutside, squareMetres)}};
  if (solved.gathered)
    text["gather"] = {
        {"texels", solved.gathered->texels}, {"drawn", solved.gathered->drawn}, {"error", solved.gathered->error}};
  if (solved.solution.isInterrupted || (options.gather && !solved.gathered)) text["interrupted"] = true;
  if (!solved.scene.wavelengths.empty()) text["bands"] = listed(solved.scene, solved.scene.wavelengths);
  return text;
}

std::string summary(const ordered_json& solution) {
  std::ostringstream text;
  text << solution["surfaces"].size() << " surfaces, " << solution["elements"] << " elements, " << solution["patches"]
       << " patches\n"
       << shotsText(solution, solution["times"]["solve_s"]);
  if (!solution["sheets"].empty()) text << sheetsText(solution["sheets"]);
  if (solution.contains("frames"))
    for (const ordered_json& frame : solution["frames"])
      text << frame["folder"].get<std::string>() << ": " << shotsText(frame, frame["times"]["update_s"]);
  text << expectedErrorText(solution) << gatherText(solution) << unitText(solution["settings"])
       << emissionText(solution) << candelaText(solution["settings"])
       << fluxText(solution["energy"], solution.contains("bands"));
  return text.str();
}

std::vector<std::string> unitWarning(const SolvedScene& solved) {
  constexpr double largestFlux = 1e6;  // in W; the lamps of a large hall emit less
  const double emitted = radiosity::bandSum(solved.solution.energy.emitted);
  const bool isOfMaterials = radiosity::brightest(solved.scene.outside) == 0 && solved.scene.lamps.empty();
  if (solved.options.metresPerUnit || !isOfMaterials || emitted < largestFlux) return {};
  return {"the scene emits " + roundedText(emitted / 1e6) + " MW and is " + roundedText(solved.scene.extent) +
          " units across; if its lengths are in millimetres, add --units mm, so that fluxes are in W"};
}

std::vector<std::string> warningsOf(const radiosity::Solution& solution) {
  std::vector<std::string> texts;
  for (const auto& [text, isAboutBacks] : solution.warnings)
    texts.push_back(text + (isAboutBacks ? " (--two-sided)" : ""));
  return texts;
}

}  // namespace hemitex::cli
