/// `hemitex solve`: progressive radiosity. An OBJ scene goes in; a folder comes out that holds the lit scene for any
/// viewer of OBJ files, a picture of it, and the numbers.
#include <bit>
#include <chrono>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>
#include <sstream>

#include "cli/camera_options.h"
#include "cli/commands.h"
#include "cli/edits_file.h"
#include "cli/json.h"
#include "cli/solution_file.h"
#include "cli/staging.h"
#include "radiosity/adaptive_discretization.h"
#include "radiosity/drawn_rows.h"
#include "radiosity/dynamic_solution.h"
#include "radiosity/lit_scene.h"
#include "radiosity/picture.h"
#include "radiosity/radiosity_texture.h"
#include "radiosity/solver.h"
#include "radiosity/texture_filter.h"
#include "radiosity/write_file.h"
#include "reference/error_bound.h"
#include "reference/ray_rows.h"

namespace hemitex::cli {
namespace {

using nlohmann::ordered_json;

struct SolveOptions {
  SceneOptions scene;
  radiosity::DiscretizationSettings discretization;
  std::optional<double> adaptive;
  radiosity::DrawingSettings drawing;
  std::string method = "hemicube";
  int samples = 1 << 16;
  radiosity::WordSettings word;
  radiosity::SolverSettings solver;
  std::optional<double> maxError;
  std::optional<radiosity::TextureFilter> filter;  ///< see texturesOf for those not asked for
  std::optional<int> magnification;
  CameraOptions camera;
  std::filesystem::path edits;  ///< none: empty
  std::filesystem::path output;
};

bool usesRays(const SolveOptions& options) { return options.method == "rays"; }

using AskedFilter = std::optional<radiosity::TextureFilter>;

std::vector<std::pair<std::string, AskedFilter>> namedFilters() {
  using radiosity::TextureFilter;
  return {{"one-to-one", TextureFilter::OneToOne}, {"triangle", TextureFilter::Triangle},
          {"bilinear", TextureFilter::Bilinear},   {"bicubic", TextureFilter::Bicubic},
          {"quadtree", TextureFilter::Quadtree},   {"gouraud", TextureFilter::Gouraud}};
}

std::string filterName(radiosity::TextureFilter filter) {
  for (const auto& [name, value] : namedFilters())
    if (value == filter) return name;
  return {};
}

/// What was asked for, or what suits the elements: filters between texels are seen only where these are magnified.
radiosity::TextureSettings texturesOf(const SolveOptions& options) {
  using radiosity::TextureFilter;
  const TextureFilter filter =
      options.filter.value_or(options.adaptive ? TextureFilter::Quadtree : TextureFilter::Triangle);
  const bool isFiner =
      filter == TextureFilter::Bilinear || filter == TextureFilter::Bicubic || filter == TextureFilter::Gouraud;
  return {filter, options.magnification.value_or(isFiner ? 4 : 1)};
}

/// Seconds that the parts of a run took.
class Stopwatch {
 public:
  /// The time since the last lap goes to `name`.
  void lap(const std::string& name) {
    const auto now = std::chrono::steady_clock::now();
    times_[name] = std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  const ordered_json& times() const { return times_; }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
  ordered_json times_;
};

/// The settings that the answer depends on: no path, no thread count.
ordered_json settingsJson(const SolveOptions& options, const radiosity::Camera& camera, double exposure) {
  const auto chartsName = [](radiosity::Charts charts) {
    return charts == radiosity::Charts::Auto ? "auto" : charts == radiosity::Charts::File ? "file" : "planar";
  };
  const auto orNull = [](const auto& value) { return value ? ordered_json(*value) : ordered_json(); };
  const auto ofProjections = [&](const auto& value) {
    return usesRays(options) ? ordered_json() : ordered_json(value);
  };
  return {{"charts", chartsName(options.scene.settings.charts)},
          {"max_reflectance", options.scene.settings.maxReflectance},
          {"two_sided", options.scene.settings.twoSided},
          {"texels", options.discretization.texels},
          {"texel_size", orNull(options.discretization.texelSize)},
          {"surface_texels", options.discretization.surfaceTexels},
          {"patch", options.discretization.patches ? ordered_json() : ordered_json(options.discretization.patch)},
          {"patches", orNull(options.discretization.patches)},
          {"adaptive", orNull(options.adaptive)},
          {"discretize", ofProjections(nameOf(options.drawing.elementsBy))},
          {"method", options.method},
          {"resolution", ofProjections(options.drawing.resolution)},
          {"orientation", ofProjections(nameOf(options.drawing.orientation))},
          {"split", ofProjections(options.drawing.split)},
          {"pixels_per_element", ofProjections(options.drawing.pixelsPerElement)},
          {"samples", usesRays(options) ? ordered_json(options.samples) : ordered_json()},
          {"format", options.word.format},
          {"index_maps", nameOf(options.word.indexMaps)},
          {"page", orNull(options.word.page)},
          {"blend", options.word.blend == raster::Blend::ClampedAdd ? "clamped-add" : "integer-add"},
          {"align", options.word.aligned},
          {"max_error", orNull(options.maxError)},
          {"residual", options.solver.shots ? ordered_json() : ordered_json(options.solver.residual)},
          {"shots", orNull(options.solver.shots)},
          {"filter", filterName(texturesOf(options).filter)},
          {"magnify", texturesOf(options).magnification},
          {"camera", toJson(camera)},
          {"size", {options.camera.width, options.camera.height}},
          {"exposure", exposure}};
}

/// How far the solution is: shots done of those asked for, or the residual's way down, on a logarithmic scale.
radiosity::Progress progressOf(const radiosity::SolverSettings& settings, Console& console) {
  return [&settings, &console](int shots, double residual) {
    const double fraction = settings.shots ? static_cast<double>(shots) / *settings.shots
                                           : std::log(residual) / std::log(settings.residual);
    console.progress(fraction, "shot " + std::to_string(shots) + ", unshot " + toText(residual));
  };
}

/// A few lines for people.
std::string summary(const ordered_json& description) {
  std::ostringstream text;
  text << description["surfaces"].size() << " surfaces, " << description["elements"] << " elements, "
       << description["patches"] << " patches, " << description["phantoms"] << " phantom indices\n"
       << description["shots"] << " shots, residual " << description["residual"] << '\n';
  if (description.contains("frames"))
    for (const ordered_json& frame : description["frames"])
      text << frame["folder"].get<std::string>() << ": " << frame["shots"] << " shots, residual " << frame["residual"]
           << '\n';
  if (description.contains("expected_error")) text << "expected error " << description["expected_error"] << '\n';
  for (const auto& [name, flux] : description["energy"].items()) text << name << ' ' << flux.dump() << '\n';
  return text.str();
}

/// A solution, and the discretization whose patches shot.
struct Solved {
  radiosity::Discretization discretization;
  radiosity::Solution solution;
  double captured = 1;  ///< of the light that leaves a patch, by what finds rows; the rest is lost
};

Solved solvedBy(const SolveOptions& options, const radiosity::Scene& scene, radiosity::Discretization discretization,
                const radiosity::WordLayout& layout, Console& console) {
  const auto solveBy = [&](const radiosity::Discretization& shooting, auto& rows) {
    const auto rowOf = [&rows](std::uint32_t patch) { return rows.ofPatch(patch); };
    radiosity::Solution solution =
        radiosity::solve(scene, shooting, rowOf, options.solver, progressOf(options.solver, console));
    console.endProgress();
    return solution;
  };
  if (usesRays(options)) {
    reference::RayRows rows(scene, discretization, {.rays = options.samples, .start = reference::RayStart::Area});
    radiosity::Solution solution = solveBy(discretization, rows);
    return {std::move(discretization), std::move(solution)};
  }
  radiosity::DrawnRows drawn(scene, std::move(discretization), layout, options.drawing);
  radiosity::Solution solution = solveBy(drawn.discretization(), drawn.rows());
  return {drawn.discretization(), std::move(solution), radiosity::formFactor(drawn.rows().projection().captured)};
}

/// Elements: texels, or leaves of quadtrees that solutions have refined.
radiosity::Discretization discretizationFor(const SolveOptions& options, const radiosity::Scene& scene,
                                            Console& console) {
  if (!options.adaptive) return discretizationOf(options.discretization, scene);
  const auto solveElements = [&](const radiosity::Discretization& discretization) {
    const radiosity::WordLayout layout = layoutOf(options.word, discretization, console);
    return solvedBy(options, scene, discretization, layout, console).solution.radiosity;
  };
  return radiosity::adaptiveDiscretization(scene, options.discretization, *options.adaptive, solveElements);
}

/// Settings as they were given, or as they were chosen for a bound on the error.
struct Settings {
  SolveOptions options;
  std::optional<double> expectedError = {};  ///< where they were chosen
};

Settings settingsFor(const SolveOptions& asked, const radiosity::Scene& scene, Console& console) {
  if (!asked.maxError) return {asked};
  SolveOptions options = asked;
  options.solver.residual = reference::residualFor(*asked.maxError);
  const int texels = asked.discretization.texels;
  const auto setEffort = [&](const reference::Effort& effort) {
    options.discretization.patches = effort.patches;
    options.drawing.resolution = effort.resolution;
    options.drawing.split = effort.split;
  };
  const auto solveWith = [&](const reference::Effort& effort) {
    setEffort(effort);
    radiosity::Discretization discretization = discretizationOf(options.discretization, scene);
    const radiosity::WordLayout layout = layoutOf(options.word, discretization, console);
    return solvedBy(options, scene, std::move(discretization), layout, console).solution.radiosity;
  };
  const reference::ErrorBoundChoice choice =
      reference::chooseEffort(scene, discretizationOf(asked.discretization, scene), texels, solveWith, *asked.maxError);
  setEffort(choice.effort);
  // What was asked for a surface binds more than what was chosen.
  options.discretization.surfaceTexels.insert(choice.surfaceTexels.begin(), choice.surfaceTexels.end());
  return {options, choice.expectedError};
}

/// A solution, and what it is one of.
struct Lit {
  const radiosity::Scene& scene;
  const radiosity::Discretization& discretization;
  const radiosity::WordLayout& layout;
  const radiosity::Solution& solution;
};

double exposureOf(const SolveOptions& options, const Lit& lit) {
  return options.camera.exposure.value_or(radiosity::defaultExposure(
      lit.scene, lit.discretization, radiosity::displayRadiosity(lit.scene, lit.discretization, lit.solution)));
}

/// The lit scene for any viewer of OBJ files, its picture and its numbers, but for solution.json.
void writeSolved(const std::filesystem::path& folder, const Lit& lit, const SolveOptions& options,
                 const radiosity::Camera& camera, double exposure) {
  radiosity::writeLitScene(folder, lit.scene, lit.discretization, lit.solution, exposure, texturesOf(options));
  // The picture shows what is in the folder: the textures that any viewer shows.
  const radiosity::Scene shown = radiosity::loadScene(folder / "scene.obj");
  radiosity::writePng(folder / "render.png",
                      radiosity::unlitPicture(shown, camera, options.camera.width, options.camera.height));
  radiosity::writeFile(folder / "scene.view.json", toText(toJson(camera)));
  std::ostringstream elements;
  writeCsv(elements, elementTable(lit.scene, lit.discretization, lit.solution));
  radiosity::writeFile(folder / "elements.csv", elements.view());
}

/// What solution.json says but for times and warnings.
ordered_json description(const Lit& lit, const SolveOptions& options, const radiosity::Camera& camera,
                         double exposure) {
  ordered_json text = {{"settings", settingsJson(options, camera, exposure)}};
  text.update(describe(lit.scene, lit.discretization, lit.layout, lit.solution));
  return text;
}

/// The update of one frame: its folder beside those of the others, and what the index of all says of it.
ordered_json writeFrame(const std::filesystem::path& folder, std::size_t number, const Frame& frame,
                        radiosity::DynamicSolution& dynamic, const SolveOptions& options,
                        const radiosity::Camera& camera, double exposure, Console& console) {
  Stopwatch watch;
  const radiosity::UpdateCost cost = dynamic.update(frame.edits, progressOf(options.solver, console));
  console.endProgress();
  watch.lap("update_s");
  const std::string name = "frame-" + std::to_string(number);
  std::filesystem::create_directory(folder / name);
  const Lit lit{dynamic.scene(), dynamic.discretization(), dynamic.layout(), dynamic.solution()};
  console.warnings(lit.solution.warnings);
  writeSolved(folder / name, lit, options, camera, exposure);
  watch.lap("write_s");
  const ordered_json rows = {{"in_windows", cost.rowsInWindows},
                             {"whole", cost.rowsWhole},
                             {"taken_back", cost.rowsTakenBack},
                             {"left", cost.rowsLeft},
                             {"started_over", cost.startedOver}};
  ordered_json text = description(lit, options, camera, exposure);
  text["edits"] = frame.written;
  text["rows"] = rows;
  text["times"] = watch.times();
  text["warnings"] = lit.solution.warnings;
  radiosity::writeFile(folder / name / "solution.json", toText(text));
  return {
      {"folder", name}, {"edits", frame.written}, {"shots", lit.solution.shots}, {"residual", lit.solution.residual},
      {"rows", rows},   {"times", watch.times()}};
}

void solve(const SolveOptions& asked, Context& context) {
  Console& console = context.console;
  Stopwatch watch;
  const radiosity::Scene scene = sceneOf(asked.scene, console);
  radiosity::requireEmission(scene, asked.scene.file);
  const radiosity::Camera camera = cameraOf(asked.camera, scene, asked.scene.file);
  const std::vector<Frame> frames =
      asked.edits.empty() ? std::vector<Frame>() : readEdits(asked.edits, scene, asked.scene.settings);
  watch.lap("load_s");
  Staging{asked.output};  // a folder that cannot be written is told before the work, not after it
  const auto [options, expectedError] = settingsFor(asked, scene, console);
  if (expectedError) watch.lap("choose_s");
  radiosity::Discretization unsplit = discretizationFor(options, scene, console);
  const radiosity::WordLayout layout = layoutOf(options.word, unsplit, console);
  watch.lap("discretize_s");
  std::unique_ptr<radiosity::DynamicSolution> dynamic;
  Solved solved;
  if (asked.edits.empty()) {
    solved = solvedBy(options, scene, std::move(unsplit), layout, console);
  } else {
    const auto layOut = [&word = options.word, &console](const radiosity::Discretization& discretization) {
      return layoutOf(word, discretization, console);
    };
    dynamic = std::make_unique<radiosity::DynamicSolution>(
        scene, std::move(unsplit), radiosity::DynamicSettings{options.discretization, options.drawing, options.solver},
        layOut, progressOf(options.solver, console));
    console.endProgress();
    solved = {dynamic->discretization(), dynamic->solution(), radiosity::formFactor(dynamic->captured())};
  }
  const Lit lit{scene, solved.discretization, layout, solved.solution};
  console.warnings(lit.solution.warnings);
  if (solved.captured < 1)
    console.warning("the single plane captures " + toText(solved.captured) +
                    " of the light that leaves a patch; the rest is lost, and the scene darker for it");
  watch.lap("solve_s");
  Staging staging(options.output);
  const double exposure = exposureOf(options, lit);
  writeSolved(staging.folder(), lit, options, camera, exposure);
  watch.lap("write_s");

  ordered_json text = description(lit, options, camera, exposure);
  text["captured"] = solved.captured;
  if (expectedError) text["expected_error"] = *expectedError;
  for (std::size_t f = 0; f < frames.size(); ++f)
    text["frames"].push_back(
        writeFrame(staging.folder(), f + 1, frames[f], *dynamic, options, camera, exposure, console));
  text["times"] = watch.times();
  text["warnings"] = console.given();
  radiosity::writeFile(staging.folder() / "solution.json", toText(text));
  staging.commit();
  std::cout << (context.json ? toText(text) : summary(text));
}

/// `--samples`: a power of two, so that every ray is a whole share of the light.
void addSamples(CLI::App& app, int& samples) {
  const auto read = [&samples](const std::string& text) {
    const int value = integerOption("--samples", text, 64, 1 << 24);
    if (!std::has_single_bit(static_cast<unsigned>(value)))
      throw CLI::ValidationError("--samples", "`" + text + "` is not a power of two");
    samples = value;
  };
  app.add_option_function<std::string>("--samples", read,
                                       "rays a patch, spread over it; a power of two (default 65536)")
      ->type_name("N");
}

/// How radiosity becomes textures.
void addTextureOptions(CLI::App& app, SolveOptions& options) {
  addChoice<AskedFilter>(app, "--filter", options.filter, namedFilters(),
                         "from elements to display textures: texels as they are, the 3 x 3 triangle filter, bilinear "
                         "or by cubic B-splines between texels, bilinear between the corners of quadtree leaves, or "
                         "elements as shaded polygons (default triangle, with --adaptive quadtree)");
  addInteger(app, "--magnify", options.magnification, 1, radiosity::mostMagnification,
             "texels of a display texture along the side of one of the grid (default 4 with bilinear, bicubic and "
             "gouraud, else 1)");
}

/// Filters between texels need texels that are elements.
void validateFilter(const SolveOptions& options) {
  using radiosity::TextureFilter;
  const TextureFilter filter = texturesOf(options).filter;
  const bool isOfTexels =
      filter == TextureFilter::Triangle || filter == TextureFilter::Bilinear || filter == TextureFilter::Bicubic;
  if (options.adaptive && isOfTexels)
    throw CLI::ValidationError("--filter", "`" + filterName(filter) +
                                               "` is between texels; with --adaptive use quadtree, "
                                               "gouraud or one-to-one");
}

}  // namespace

void addSolve(CLI::App& program, Context& context) {
  const auto options = std::make_shared<SolveOptions>();
  CLI::App* command = program.add_subcommand("solve", "Light a scene by progressive radiosity");
  addSceneOptions(*command, options->scene);
  addOutput(*command, options->output, "folder for the lit scene");
  addDiscretizationOptions(*command, options->discretization);
  addChoice<std::string>(
      *command, "--method", options->method,
      {{"hemicube", "hemicube"}, {"single-plane", "single-plane"}, {"tetrahedron", "tetrahedron"}, {"rays", "rays"}},
      "what finds form factors (default hemicube); what rays find differs between machines in the last digits");
  addDrawingOptions(*command, options->drawing);
  addSamples(*command, options->samples);
  addWordOptions(*command, options->word);
  CLI::Option* residual =
      addPositive(*command, "--residual", options->solver.residual, std::numeric_limits<double>::infinity(),
                  "stop when unshot over emitted flux is at most this (default 0.001)");
  addInteger(*command, "--shots", options->solver.shots, 0, std::numeric_limits<int>::max(), "stop after N shots")
      ->excludes(residual);
  const auto readCache = [options](const std::string& text) {
    const int mebibytes = integerOption("--row-cache", text, 0, std::numeric_limits<int>::max());
    options->solver.rowCacheBytes = static_cast<std::size_t>(mebibytes) << 20;
  };
  command->add_option_function<std::string>("--row-cache", readCache, "rows kept for later shots (default 1024)")
      ->type_name("MIB");
  CLI::Option* maxError = addPositive(
      *command, "--max-error", options->maxError, 1,
      "let the error of the elements' radiosity be at most this share of all light, weighted by flux: resolution, "
      "patches, splits, residual and coarser index maps than --texels are chosen for it");
  for (const char* chosen : {"--resolution", "--orientation", "--split", "--pixels-per-element", "--patch",
                             "--texel-size", "--residual", "--shots", "--samples"})
    maxError->excludes(command->get_option(chosen));
  CLI::Option* adaptive = addPositive(
      *command, "--adaptive", options->adaptive, 1,
      "quadtrees: from 4 x 4 elements a surface down to its --texels, a power of two, split each one whose area times "
      "the change of radiosity across it is above this share of all light (0.0001 is a start)");
  for (const char* other : {"--texel-size", "--max-error"}) adaptive->excludes(command->get_option(other));
  addTextureOptions(*command, *options);
  addCameraOptions(*command, options->camera);
  command
      ->add_option("--edits", options->edits,
                   "frames of edits (objects that move, come or go, lights, reflectances); the solution is updated for "
                   "each, into a folder of its own")
      ->type_name("FILE.json")
      ->excludes(adaptive)
      // Coarser maps move light beyond the pixels that bound what an edit changes.
      ->excludes(command->get_option("--pixels-per-element"));
  command->callback([options, command, &context] {
    refuseUnused(*command, usesRays(*options) ? drawingOptionNames() : std::vector<std::string>{"--samples"},
                 options->method);
    // What errors grow to was learnt of hemicubes.
    if (options->method != "hemicube") refuseUnused(*command, {"--max-error"}, options->method);
    if (const auto projection = projectionNamed(options->method)) options->drawing.projection = *projection;
    validateFilter(*options);
    if (usesRays(*options)) refuseUnused(*command, {"--edits"}, options->method);
    if (options->drawing.elementsBy == radiosity::ElementsBy::Mesh && !options->edits.empty())
      throw CLI::ValidationError("--edits", "has no use with --discretize mesh; leave one of them out");
    context.command = [options, &context] { solve(*options, context); };
  });
}

}  // namespace hemitex::cli
