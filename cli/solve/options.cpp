#include "cli/solve/options.h"

#include <limits>
#include <utility>

#include "cli/solve/bands_file.h"
#include "radiosity/bands/spectral_scene.h"
#include "radiosity/gather/final_gather.h"
#include "radiosity/meshes/length_unit.h"
#include "radiosity/scene/load_scene.h"

namespace hemitex::cli {
namespace {

using radiosity::TextureFilter;

constexpr int maxMagnification = 16;

const Choices<TextureFilter> filterChoices{
    {"one-to-one", TextureFilter::OneToOne}, {"triangle", TextureFilter::Triangle},
    {"bilinear", TextureFilter::Bilinear},   {"bicubic", TextureFilter::Bicubic},
    {"quadtree", TextureFilter::Quadtree},   {"gouraud", TextureFilter::Gouraud}};

/// Adds the options for the unit of lengths, in which fluxes and scene.glb are written.
void addUnits(Command command, std::optional<double>& metresPerUnit) {
  command = command.under("Scene");
  const Option units = addChoice<double>(
      command, "--units", metresPerUnit, {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}},
      "unit of lengths in the scene (default: that of a comment in the OBJ file, or m). Fluxes in W follow from it; "
      "radiosity does not.");
  addPositive(command, "--scale", metresPerUnit, std::numeric_limits<double>::infinity(),
              "metres per unit of length in the scene; 0.001 is the same as --units mm")
      .excludes(units);
}

/// Adds `--samples`, a power of two: then the share of each ray is an integer.
void addSamples(Command command, int& samples) {
  const auto read = [&samples](const std::string& text) { samples = powerOfTwoOption("--samples", text, 64, 1 << 24); };
  command.addText("--samples", "N", "cast N rays per patch, with --method rays; a power of two (default 65536)", read);
}

/// Adds the options for computing form-factor rows.
void addMethodOptions(Command command, SolveOptions& options) {
  command = command.under("Form factors");
  addMethod(
      command, options.method, {"rays"},
      "compute form factors with this projection or with rays (default hemicube). The result of rays differs between "
      "machines in the last digits.");
  addDrawingOptions(command, options.drawing);
  addRowDevice(command, options.device);
  addSamples(command, options.samples);
  addSeed(command, options.seed);
}

/// Adds the options for ending the solution and for memory.
void addSolverOptions(Command command, SolveOptions& options) {
  radiosity::SolverSettings& settings = options.solver;
  command = command.under("Accuracy and memory");
  addPositive(command, "--residual", options.residual, std::numeric_limits<double>::infinity(),
              "stop when the unshot flux is at most this share of the emitted flux (default 0.001; with light "
              "from outside 0.001 of what stays in rooms, at least 0.00001 of all; and less until what the camera sees "
              "is lit; with --max-error a tenth of the bound, if that is less)");
  addInteger(command, "--shots", settings.shots, 0, std::numeric_limits<int>::max(),
             "stop after N shots, or at the residual, whichever comes first (default: see --residual)");
  const auto readCache = [&settings](const std::string& text) {
    const int mebibytes = integerOption("--row-cache", text, 0, std::numeric_limits<int>::max());
    settings.rowCacheBytes = static_cast<std::size_t>(mebibytes) << 20;
  };
  command.addText("--row-cache", "MIB",
                  "keep at most MIB mebibytes of form-factor rows for later shots of the same patches (default 1024)",
                  readCache);
}

/// Adds the options that choose other settings: --max-error and --adaptive.
void addChosenSettings(Command command, SolveOptions& options) {
  addPositive(command.under("Accuracy and memory"), "--max-error", options.maxError, 1,
              "choose --resolution, --split and --residual so that the expected error is at most this share, such as "
              "0.01, both of all flux and of the flux of the surfaces that the camera sees; given values limit the "
              "choice. Of facets without texels, bound the error of every row of form factors, as `hemitex "
              "formfactors` does (default: use the given values)");
  addPositive(
      command.under("Elements"), "--adaptive", options.adaptive, 1,
      "subdivide elements in quadtrees where radiosity changes fast, from 4 x 4 elements per surface to its --texels "
      "or --texel-size, rounded up to a power of two (default: no quadtrees). An element is split if its area times "
      "the change across it is above this share of all flux. 0.0001 is a good start.");
}

/// Adds --facets, --no-facets and --matrix.
void addFacetOptions(Command command, SolveOptions& options) {
  const Option none = command.under("Elements")
                          .addFlag("--no-facets", options.noFacets,
                                   "join the faces of a mesh into surfaces with texels, as those of a scene");
  command.under("Elements")
      .addFlag("--facets", options.facets,
               "make every face of the file a surface of one element, numbered from 0, and also write scene.vtu for "
               "ParaView (default for meshes without materials, such as STL and VTU, unless --two-sided, --adaptive or "
               "--edits is given)")
      .excludes(none);
  const Option matrix = command.under("Form factors")
                            .addPath("--matrix", options.matrix,
                                     "take the form factors of facets from this file, which `hemitex formfactors "
                                     "--all` or another program computed for the same mesh (default: compute them)",
                                     "FILE");
  for (const char* other : {"--no-facets", "--texels", "--texel-size", "--surface", "--adaptive", "--method",
                            "--resolution", "--orientation", "--split", "--device"})
    matrix.excludes(command.option(other));
}

/// Chooses facets where they are asked for, and for meshes without materials.
void completeFacets(SolveOptions& options) {
  const bool isDefault = radiosity::isPlainMesh(options.scene.file) && !options.noFacets &&
                         options.scene.settings.sides != radiosity::Sides::Two && !options.adaptive &&
                         options.edits.empty();
  if (!options.facets && !isDefault && options.matrix.empty()) return;
  chooseFacets(options.scene.settings, options.discretization);
}

/// Adds the options of display textures.
void addTextureOptions(Command command, SolveOptions& options) {
  command = command.under("Output");
  addChoice(
      command, "--filter", options.filter, filterChoices,
      "interpolate elements in display textures: none (one-to-one), by a 3 x 3 triangle filter, bilinear or cubic "
      "B-splines between texels, bilinear in quadtree leaves, or Gouraud shading (default bicubic; "
      "with --adaptive quadtree; one-to-one for facets)");
  addInteger(command, "--magnify", options.magnification, 1, maxMagnification,
             "make display textures N times as wide and high as the grid (default 1 with one-to-one, else so that each "
             "surface has at least 128 texels along its longer side, and all have at most 2^26)");
}

/// Adds the final gather, which has no use for filters.
void addGather(Command command, SolveOptions& options) {
  command = command.under("Output");
  command
      .addFlag("--gather", options.gather,
               "compute the light of each texel of display textures, light maps and NAME.exr from all that the texel "
               "sees, instead of filtering elements: sharp shadows, dark corners, no mottling")
      .excludes(command.option("--filter"));
}

/// The option of all commands, which the help of this one shows, too.
void addInsist(Command command, bool& insists) {
  command.under("Accuracy and memory")
      .addFlag("--insist", insists,
               "run with more than 2^24 elements, or with more memory than is free (default: refuse, with the number)");
}

/// Adds the options that leave out large files.
void addOmissions(Command command, SolveOptions& options) {
  command = command.under("Output");
  command.addFlag("--no-elements", options.noElements, "do not write elements.csv, which has a line per element");
  command.addFlag("--no-textures", options.noTextures,
                  "do not write textures, nor scene.obj, scene.mtl and scene.glb, which show them; render.png shows "
                  "elements without filtering. For scenes of many millions of elements.");
}

void addEdits(Command command, std::filesystem::path& edits) {
  command.under("Changes over time")
      .addPath("--edits", edits,
               "update the solution for each frame of edits in the file, and write each frame into its own folder. "
               "Edits move, "
               "add and remove objects, or change lights and reflectances.",
               "FILE.json");
}

void addLongRunOptions(Command command, LongRunOptions& longRun) {
  command = command.under("Long runs");
  const Option checkpoint = command.addOutputFile(
      "--checkpoint", longRun.checkpoint,
      "store the solution in this file from time to time, and after a signal that stops the run", "FILE");
  command.addPath("--resume", longRun.resume,
                  "go on from a file of --checkpoint, with the same scene and options; the "
                  "result is that of a run without a stop",
                  "FILE");
  addPositive(command, "--every", longRun.every, 1e6, "seconds between two checkpoints (default 60)").needs(checkpoint);
  addChoice<bool>(command, "--progress", longRun.isForPrograms, {{"bar", false}, {"json", true}},
                  "show progress as a bar on a terminal, or as lines of JSON on stderr for programs (default "
                  "bar)");
}

void addBands(Command command, std::filesystem::path& bands) {
  command.under("Light and reflectance")
      .addPath(
          "--bands", bands,
          "solve the bands of wavelengths in this JSON or CSV file, with its spectra of materials and those of the "
          "MTL file, and show their colours (default: solve R, G and B)",
          "FILE");
}

/// Throws a usage error for a filter between texels with quadtrees, whose elements are not texels.
void validateFilter(const SolveOptions& options) {
  const TextureFilter filter = filterOf(options);
  const bool isOfTexels =
      filter == TextureFilter::Triangle || filter == TextureFilter::Bilinear || filter == TextureFilter::Bicubic;
  if (options.adaptive && isOfTexels)
    usageError("--filter",
               "`" + nameOf(filter) + "` filters between texels; with --adaptive use quadtree, gouraud or one-to-one");
}

}  // namespace

void addSolveOptions(Command command, SolveOptions& options, Context& context) {
  addOutput(command.under("Output"), options.output, "write the lit scene into this folder");
  command.under("Output").addFlag("--report", options.report,
                                  "also write report.html, which shows the lit scene in 3-D, where the flux went, the "
                                  "convergence, the settings and warnings; it works without a network");
  command.under("Output").addFlag(
      "--lightmap", options.lightmap,
      "also write lightmap.glb, the scene with its own materials, and light maps: the light "
      "without the colours of surfaces, for programs that multiply both");
  addSceneOptions(command, options.scene);
  addUnits(command, options.metresPerUnit);
  addDiscretizationOptions(command, options.discretization);
  addMethodOptions(command, options);
  addIdOptions(command, options.id);
  addSolverOptions(command, options);
  addChosenSettings(command, options);
  addInsist(command, context.insists);
  addTextureOptions(command, options);
  addGather(command, options);
  addOmissions(command, options);
  addCameraOptions(command, options.camera);
  addEdits(command, options.edits);
  addFacetOptions(command, options);
  addLongRunOptions(command, options.longRun);
  addBands(command, options.bands);
  command.showFirst({"--output", "--report", "--emit", "--reflectance", "--texels", "--resolution", "--max-error",
                     "--residual", "--size"});
}

namespace {

radiosity::Scene sceneInBands(const SolveOptions& options) {
  if (options.bands.empty()) return loadedScene(options.scene);
  SceneOptions unchanged = options.scene;
  unchanged.materials = {};
  const radiosity::SceneSettings& settings = options.scene.settings;
  radiosity::Scene scene = loadedScene(unchanged);
  const BandsFile read = readBands(options.bands, scene, settings);
  scene = withMaterials(radiosity::inBands(std::move(scene), read.bands, settings.maxReflectance),
                        options.scene.materials, settings);
  scene.files.insert(scene.files.end(), read.files.begin(), read.files.end());
  requireLight(scene, options.scene.file);
  return scene;
}

}  // namespace

SolveOptions withStatedUnit(SolveOptions options, std::vector<std::string>& warnings) {
  if (!options.metresPerUnit) options.metresPerUnit = radiosity::statedMetresPerUnit(options.scene.file, warnings);
  return options;
}

radiosity::Scene loadedScene(const SolveOptions& options) {
  radiosity::Scene scene = sceneInBands(options);
  scene.squareMetres = squareMetresPerUnit(options);
  return scene;
}

void completeOptions(Command command, SolveOptions& options) {
  refuseUnused(command, usesRays(options) ? drawingOptionNames() : std::vector<std::string>{"--samples", "--seed"},
               options.method);
  // --max-error chooses settings of hemicubes.
  if (options.method != "hemicube") refuseUnused(command, {"--max-error"}, options.method);
  // Quadtrees begin with a few elements, and their texels are only the finest ones.
  if (options.adaptive && !options.discretization.texelSize)
    options.discretization.texels = options.discretization.texels.value_or(16);
  completeFacets(options);
  if (boundsRows(options)) {
    refuseUnused(command, drawingOptionNames(), "hemicube --max-error for facets");
    refuseUnused(command, {"--split", "--patch"}, "hemicube --max-error for facets");
  }
  if (boundsLight(options)) {
    if (command.isGiven("--resolution")) options.coarsest.resolution = options.drawing.resolution;
    if (command.isGiven("--split")) options.coarsest.split = options.drawing.split;
  }
  if (!hasTextures(options))
    for (const char* ofTextures : {"--filter", "--magnify", "--gather"})
      if (command.isGiven(ofTextures)) usageError(ofTextures, "is of textures, which --no-textures leaves out");
  if (const auto projection = projectionNamed(options.method)) options.drawing.projection = *projection;
  options.solver.keepsIrradiance = options.lightmap;
  validateFilter(options);
  options.isContinued = !options.edits.empty();
}

bool usesRays(const SolveOptions& options) { return options.method == "rays"; }

bool boundsRows(const SolveOptions& options) {
  const radiosity::DiscretizationSettings& elements = options.discretization;
  const bool areElements = elements.texels == 1 && elements.surfaceTexels.empty() && !options.adaptive;
  return options.maxError && options.scene.settings.facets && areElements && options.matrix.empty();
}

bool boundsLight(const SolveOptions& options) {
  return options.maxError && !boundsRows(options) && options.matrix.empty();
}

bool followsCamera(const SolveOptions& options) {
  return options.maxError ? boundsLight(options) : !options.residual && !options.solver.shots;
}

bool usesDrawnRows(const SolveOptions& options) {
  return !usesRays(options) && !boundsRows(options) && options.matrix.empty();
}

bool hasTextures(const SolveOptions& options) { return !options.noTextures || options.lightmap; }

bool writesFacets(const SolveOptions& options) { return options.scene.settings.facets && !options.isContinued; }

double squareMetresPerUnit(const SolveOptions& options) {
  const double metres = options.metresPerUnit.value_or(1);
  return metres * metres;
}

TextureFilter filterOf(const SolveOptions& options) {
  const bool areFacets = options.scene.settings.facets && options.discretization.texels == 1;
  return options.filter.value_or(options.adaptive ? TextureFilter::Quadtree
                                 : areFacets      ? TextureFilter::OneToOne
                                                  : TextureFilter::Bicubic);
}

radiosity::Magnification magnificationOf(const SolveOptions& options) {
  if (options.gather) return {options.magnification, radiosity::maxGatheredTexels};
  if (filterOf(options) == TextureFilter::OneToOne) return {options.magnification.value_or(1)};
  return {options.magnification};
}

std::string nameOf(TextureFilter filter) { return nameOf(filterChoices, filter); }

}  // namespace hemitex::cli
