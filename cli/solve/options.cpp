#include "cli/solve/options.h"

#include <bit>
#include <limits>

namespace hemitex::cli {
namespace {

using radiosity::TextureFilter;
using AskedFilter = std::optional<TextureFilter>;

std::vector<std::pair<std::string, AskedFilter>> namedFilters() {
  return {{"one-to-one", TextureFilter::OneToOne}, {"triangle", TextureFilter::Triangle},
          {"bilinear", TextureFilter::Bilinear},   {"bicubic", TextureFilter::Bicubic},
          {"quadtree", TextureFilter::Quadtree},   {"gouraud", TextureFilter::Gouraud}};
}

/// `--samples`: a power of two, so that every ray is a whole share of the light.
void addSamples(Command command, int& samples) {
  const auto read = [&samples](const std::string& text) {
    const int value = integerOption("--samples", text, 64, 1 << 24);
    if (!std::has_single_bit(static_cast<unsigned>(value)))
      usageError("--samples", "`" + text + "` is not a power of two");
    samples = value;
  };
  command.addText("--samples", "N", "rays a patch, spread over it; a power of two (default 65536)", read);
}

/// What finds rows of form factors.
void addMethodOptions(Command command, SolveOptions& options) {
  addChoice<std::string>(
      command, "--method", options.method,
      {{"hemicube", "hemicube"}, {"single-plane", "single-plane"}, {"tetrahedron", "tetrahedron"}, {"rays", "rays"}},
      "what finds form factors (default hemicube); what rays find differs between machines in the last digits");
  addDrawingOptions(command, options.drawing);
  addSamples(command, options.samples);
}

/// When to stop, and what to keep until then.
void addSolverOptions(Command command, radiosity::SolverSettings& settings) {
  const Option residual = addPositive(command, "--residual", settings.residual, std::numeric_limits<double>::infinity(),
                                      "stop when unshot over emitted flux is at most this (default 0.001)");
  addInteger(command, "--shots", settings.shots, 0, std::numeric_limits<int>::max(), "stop after N shots")
      .excludes(residual);
  const auto readCache = [&settings](const std::string& text) {
    const int mebibytes = integerOption("--row-cache", text, 0, std::numeric_limits<int>::max());
    settings.rowCacheBytes = static_cast<std::size_t>(mebibytes) << 20;
  };
  command.addText("--row-cache", "MIB", "rows kept for later shots (default 1024)", readCache);
}

/// Settings that are chosen: for a bound on the error, or where light changes.
void addChosenSettings(Command command, SolveOptions& options) {
  const Option maxError = addPositive(
      command, "--max-error", options.maxError, 1,
      "let the error of the elements' radiosity be at most this share of all light, weighted by flux: resolution, "
      "splits and residual are chosen for it");
  for (const char* chosen :
       {"--resolution", "--orientation", "--split", "--pixels-per-element", "--residual", "--shots", "--samples"})
    maxError.excludes(command.option(chosen));
  const Option adaptive = addPositive(
      command, "--adaptive", options.adaptive, 1,
      "quadtrees: from 4 x 4 elements a surface down to its --texels, a power of two, split each one whose area times "
      "the change of radiosity across it is above this share of all light (0.0001 is a start)");
  for (const char* other : {"--texel-size", "--max-error"}) adaptive.excludes(command.option(other));
}

/// How radiosity becomes textures.
void addTextureOptions(Command command, SolveOptions& options) {
  addChoice<AskedFilter>(command, "--filter", options.filter, namedFilters(),
                         "from elements to display textures: texels as they are, the 3 x 3 triangle filter, bilinear "
                         "or by cubic B-splines between texels, bilinear between the corners of quadtree leaves, or "
                         "elements as shaded polygons (default triangle, with --adaptive quadtree)");
  addInteger(command, "--magnify", options.magnification, 1, radiosity::maxMagnification,
             "texels of a display texture along the side of one of the grid (default 4 with bilinear, bicubic and "
             "gouraud, else 1)");
}

void addEdits(Command command, std::filesystem::path& edits) {
  command
      .addText("--edits", "FILE.json",
               "frames of edits (objects that move, come or go, lights, reflectances); the solution is updated for "
               "each, into a folder of its own",
               [&edits](const std::string& text) { edits = text; })
      .excludes(command.option("--adaptive"))
      // Coarser maps move light beyond the pixels that bound what an edit changes.
      .excludes(command.option("--pixels-per-element"));
}

/// Filters between texels need texels that are elements.
void validateFilter(const SolveOptions& options) {
  const TextureFilter filter = texturesOf(options).filter;
  const bool isOfTexels =
      filter == TextureFilter::Triangle || filter == TextureFilter::Bilinear || filter == TextureFilter::Bicubic;
  if (options.adaptive && isOfTexels)
    usageError("--filter", "`" + nameOf(filter) +
                               "` is between texels; with --adaptive use quadtree, "
                               "gouraud or one-to-one");
}

}  // namespace

void addSolveOptions(Command command, SolveOptions& options) {
  addSceneOptions(command, options.scene);
  addOutput(command, options.output, "folder for the lit scene");
  addDiscretizationOptions(command, options.discretization);
  addMethodOptions(command, options);
  addIdOptions(command, options.id);
  addSolverOptions(command, options.solver);
  addChosenSettings(command, options);
  addTextureOptions(command, options);
  addCameraOptions(command, options.camera);
  addEdits(command, options.edits);
}

void completeOptions(Command command, SolveOptions& options) {
  refuseUnused(command, usesRays(options) ? drawingOptionNames() : std::vector<std::string>{"--samples"},
               options.method);
  // What is chosen are settings of hemicubes.
  if (options.method != "hemicube") refuseUnused(command, {"--max-error"}, options.method);
  // Quadtrees stand over grids of one power of two.
  if (options.adaptive && !options.discretization.texels) options.discretization.texels = 16;
  if (const auto projection = projectionNamed(options.method)) options.drawing.projection = *projection;
  validateFilter(options);
  if (usesRays(options)) refuseUnused(command, {"--edits"}, options.method);
  if (options.drawing.elementsBy == radiosity::ElementsBy::Mesh && !options.edits.empty())
    usageError("--edits", "has no use with --discretize mesh; leave one of them out");
}

bool usesRays(const SolveOptions& options) { return options.method == "rays"; }

radiosity::TextureSettings texturesOf(const SolveOptions& options) {
  const TextureFilter filter =
      options.filter.value_or(options.adaptive ? TextureFilter::Quadtree : TextureFilter::Triangle);
  const bool isFiner =
      filter == TextureFilter::Bilinear || filter == TextureFilter::Bicubic || filter == TextureFilter::Gouraud;
  return {filter, options.magnification.value_or(isFiner ? 4 : 1)};
}

std::string nameOf(TextureFilter filter) {
  for (const auto& [name, value] : namedFilters())
    if (value == filter) return name;
  return {};
}

}  // namespace hemitex::cli
