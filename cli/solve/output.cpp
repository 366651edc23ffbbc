#include "cli/solve/output.h"

#include <iomanip>
#include <numeric>
#include <sstream>

#include "cli/common/json.h"
#include "cli/common/numbers.h"
#include "cli/solve/solution_json.h"
#include "radiosity/pictures/pictures.h"
#include "radiosity/textures/lit_scene.h"
#include "radiosity/textures/radiosity_texture.h"
#include "raster/base/file_io.h"

namespace hemitex::cli {

using nlohmann::ordered_json;

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
                   {"residual", options.solver.shots ? ordered_json() : ordered_json(options.solver.residual)},
                   {"shots", orNull(options.solver.shots)}});
  return settings;
}

namespace {

/// The settings that the result depends on.
ordered_json settingsJson(const Display& display) {
  const SolveOptions& options = display.options;
  ordered_json settings = solutionSettings(options);
  settings.update({{"filter", options.noTextures ? ordered_json() : ordered_json(nameOf(filterOf(options)))},
                   {"magnify", orNull(options.magnification)},
                   {"camera", toJson(display.camera)},
                   {"size", {options.camera.width, options.camera.height}},
                   {"exposure", display.exposure}});
  return settings;
}

/// Nothing with --no-textures.
std::optional<radiosity::TextureLayout> textureLayout(const SolveOptions& options, const SolvedScene& solved) {
  if (options.noTextures) return std::nullopt;
  return radiosity::layOutTextures(solved.scene, solved.discretization, magnificationOf(options));
}

radiosity::ElementValues displayed(const SolvedScene& solved) {
  return [&solved](std::uint32_t element) {
    return radiosity::displayRadiosity(solved.scene, solved.discretization, solved.solution, element);
  };
}

/// The light of each element, without filtering.
radiosity::Image elementPicture(const SolvedScene& solved, const Display& display) {
  const auto colours = [&, light = displayed(solved)](std::uint32_t element) {
    return light(element) * display.exposure;
  };
  return radiosity::elementPicture(solved.scene, solved.discretization, colours, display.camera,
                                   display.options.camera.width, display.options.camera.height);
}

std::string shotsText(const ordered_json& solution, double seconds) {
  return std::to_string(solution["shots"].get<int>()) + " shots in " + roundedText(seconds) + " s, " +
         percentText(solution["residual"]) + " of the emitted flux unshot\n";
}

std::string titleOf(const std::string& flux) {
  if (flux == "lost_to_backs") return "  to backs";
  return flux == "sky_on_backs" ? "sky on backs" : flux;
}

/// One line per kind of flux: W in each band, and the share of the emitted flux, summed over bands.
std::string fluxText(const ordered_json& energy) {
  const auto sum = [](const ordered_json& bands) {
    return bands[0].get<double>() + bands[1].get<double>() + bands[2].get<double>();
  };
  const double emitted = sum(energy["emitted"]);
  std::ostringstream text;
  text << '\n' << std::left << std::setw(16) << "flux in W" << std::right;
  for (const char* title : {"red", "green", "blue", "of emitted"}) text << std::setw(12) << title;
  for (const auto& [name, bands] : energy.items()) {
    text << '\n' << std::left << std::setw(16) << titleOf(name) << std::right;
    for (const ordered_json& flux : bands) text << std::setw(12) << roundedText(flux);
    text << std::setw(12) << (emitted > 0 ? percentText(sum(bands) / emitted) : "-");
  }
  text << '\n';
  return text.str();
}

}  // namespace

double exposureOf(const SolveOptions& options, const SolvedScene& solved) {
  if (options.camera.exposure) return *options.camera.exposure;
  return radiosity::defaultExposure(solved.scene, solved.discretization, displayed(solved));
}

std::optional<radiosity::LitScene> shownScene(const SolvedScene& solved, const Display& display) {
  const std::optional<radiosity::TextureLayout> layout = textureLayout(display.options, solved);
  if (!layout) return std::nullopt;
  return radiosity::makeLitScene(solved.scene, solved.discretization, *layout,
                                 radiosity::displayRadiosity(solved.scene, solved.discretization, solved.solution),
                                 display.exposure, filterOf(display.options));
}

std::vector<std::string> writeSolved(const std::filesystem::path& folder, const SolvedScene& solved,
                                     const std::optional<radiosity::LitScene>& shown, const Display& display) {
  const int width = display.options.camera.width, height = display.options.camera.height;
  const radiosity::PictureView view{display.camera, static_cast<double>(width) / height};
  std::vector<std::string> warnings;
  if (shown)
    warnings = radiosity::writeLitScene(folder, *shown, view, solved.discretization, solved.solution.radiosity);
  radiosity::writePng(folder / "render.png", shown ? radiosity::unlitPicture(*shown, display.camera, width, height)
                                                   : elementPicture(solved, display));
  raster::writeFile(folder / "scene.view.json", toText(toJson(display.camera)));
  if (!display.options.noElements)
    raster::writeFile(folder / "elements.csv", [&solved](std::ostream& stream) {
      writeCsv(stream, elementTable(solved.scene, solved.discretization, solved.solution));
    });
  return warnings;
}

SolveRecord recordOf(const SolvedScene& solved, const SolveOptions& options, const Convergence& convergence) {
  constexpr std::size_t maxPatches = 256;  // so that the page costs at most some hundred hemicubes
  const std::vector<glm::dvec3>& absorbed = solved.solution.absorbedByBacks;
  SolveRecord record{convergence,
                     radiosity::backAbsorption(solved.scene, solved.discretization, solved.layout, options.drawing,
                                               absorbed, maxPatches),
                     std::vector<glm::dvec3>(solved.scene.surfaces.size())};
  for (std::size_t p = 0; p < absorbed.size(); ++p)
    record.lostToBacks[solved.discretization.patches.list[p].surface] += absorbed[p];
  return record;
}

void writeReport(const std::filesystem::path& folder, const radiosity::LitScene& shown, const ordered_json& solution,
                 const SolveRecord& record) {
  std::vector<std::uint32_t> surfaces(shown.scene.surfaces.size());
  std::iota(surfaces.begin(), surfaces.end(), 0u);
  raster::writeFile(folder / "report.html",
                    solvedPage({folder / "scene.glb", shown.scene, surfaces}, solution, record));
}

ordered_json description(const SolvedScene& solved, const Display& display) {
  ordered_json text = {{"settings", settingsJson(display)}};
  const MaterialOptions& materials = display.options.scene.materials;
  if (materials.changeMaterials()) text["settings"]["materials"] = toJson(materials);
  text["settings"].update(toJson(solved.scene.outside));
  text.update(describe(solved.scene, solved.discretization, solved.layout, textureLayout(display.options, solved),
                       solved.solution));
  return text;
}

std::string summary(const ordered_json& solution) {
  std::ostringstream text;
  text << solution["surfaces"].size() << " surfaces, " << solution["elements"] << " elements, " << solution["patches"]
       << " patches\n"
       << shotsText(solution, solution["times"]["solve_s"]);
  if (solution.contains("frames"))
    for (const ordered_json& frame : solution["frames"])
      text << frame["folder"].get<std::string>() << ": " << shotsText(frame, frame["times"]["update_s"]);
  text << "expected error: "
       << (solution["expected_error"].is_null() ? "not measured; --max-error measures it"
                                                : percentText(solution["expected_error"]) + " of all flux")
       << '\n';
  text << fluxText(solution["energy"]);
  return text.str();
}

std::string filesText(const SolveOptions& options) {
  const auto line = [&options](const std::string& what, const char* file) {
    return what + (options.output / file).string() + '\n';
  };
  return '\n' + line("picture:    ", "render.png") + (options.noTextures ? "" : line("lit scene:  ", "scene.obj")) +
         line("numbers:    ", "solution.json") + (options.report ? line("page:       ", "report.html") : "");
}

}  // namespace hemitex::cli
