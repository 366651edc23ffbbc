#include "cli/scene/scene_options.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "cli/common/json.h"
#include "cli/scene/symmetry_options.h"
#include "radiosity/discretization/discretize.h"
#include "radiosity/discretization/exposure.h"
#include "radiosity/scene/load_scene.h"
#include "radiosity/scene/surface_names.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {

namespace {

using nlohmann::ordered_json;
using radiosity::Charts;
using radiosity::ElementsBy;
using radiosity::EmissionUnit;
using radiosity::IndexMaps;
using radiosity::Orientation;
using radiosity::ProjectionKind;

const Choices<Charts> chartsChoices{{"auto", Charts::Auto}, {"file", Charts::File}, {"planar", Charts::Planar}};
const Choices<EmissionUnit> emissionChoices{{"radiosity", EmissionUnit::Radiosity},
                                            {"radiance", EmissionUnit::Radiance}};
const Choices<IndexMaps> indexMapsChoices{
    {"shared", IndexMaps::Shared}, {"packed", IndexMaps::Packed}, {"unique", IndexMaps::Unique}};
const Choices<raster::Blend> blendChoices{{"clamped-add", raster::Blend::ClampedAdd},
                                          {"integer-add", raster::Blend::IntegerAdd}};
const Choices<ElementsBy> elementsByChoices{{"texture", ElementsBy::Texture}, {"mesh", ElementsBy::Mesh}};
const Choices<Orientation> orientationChoices{{"aligned", Orientation::Aligned}, {"turned", Orientation::Turned}};

constexpr int largestTexels = 4096;
constexpr int largestResolution = 4096;

int resolutionOption(const std::string& text) {
  const int value = integerOption("--resolution", text, 2, largestResolution);
  if (value % 2 != 0) usageError("--resolution", "`" + text + "` is not an even number");
  return value;
}

/// The names of the three largest families, largest first; of equal ones the first.
std::vector<std::string> largestFamilies(const radiosity::Scene& scene) {
  const radiosity::Families families = radiosity::familiesOf(scene);
  std::vector<double> areas;
  for (const std::vector<std::uint32_t>& surfaces : families.surfaces) {
    areas.push_back(0);
    for (const std::uint32_t s : surfaces) areas.back() += radiosity::area(scene.surfaces[s]);
  }
  std::vector<std::size_t> order(areas.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return areas[a] > areas[b]; });
  order.resize(std::min<std::size_t>(order.size(), 3));
  std::vector<std::string> names;
  for (const std::size_t family : order) names.push_back(families.names[family]);
  return names;
}

const std::string overflowText =
    "offsets without alignment overflow the channels of a clamped add, so that wrong elements receive light";
const std::string overflowAdvice = "use --blend integer-add";

bool overflows(const radiosity::IdSettings& settings) {
  return !settings.aligned && settings.indexMaps != IndexMaps::Unique && settings.blend == raster::Blend::ClampedAdd;
}

radiosity::IdLayout anyLayoutOf(const radiosity::IdSettings& settings,
                                const radiosity::Discretization& discretization) {
  const bool hasOffsets = settings.page || settings.blend != raster::Blend::ClampedAdd || !settings.aligned;
  if (settings.indexMaps == IndexMaps::Unique && hasOffsets)
    throw raster::InputError("unique index maps have no offsets", "omit --page, --blend and --no-align");
  return radiosity::layOut(discretization, settings);
}

/// Adds `--cell-reflectance` and `--cell-emission`.
void addCellOptions(Command command, radiosity::SceneSettings& settings) {
  command = command.under("Light and reflectance");
  const std::string ofVtk =
      " of each face in the cell data NAME of a VTK file, of one component or three (red, green, "
      "blue)";
  command.addText("--cell-reflectance", "NAME", "read the reflectance" + ofVtk, settings.cellReflectance);
  command.addText("--cell-emission", "NAME", "read the emission" + ofVtk + "; see --emission for its unit",
                  settings.cellEmission);
}

}  // namespace

void addSceneOptions(Command command, SceneOptions& options) {
  command = command.under("Scene");
  command
      .addPath("SCENE", options.file,
               "scene: Wavefront OBJ, glTF 2.0 (.gltf, .glb), or a mesh (.stl, .ply, .vtu, .vtp, .vtk, .vs3)")
      .required();
  addChoice(command, "--charts", options.settings.charts, chartsChoices,
            "take charts from the texture coordinates of the file (file), or make one per planar part (planar); auto "
            "uses the coordinates that form a chart, and otherwise one per planar or curved part (default auto)");
  addPositive(command, "--crease", options.settings.crease, 180.0,
              "separate curved parts where faces meet at a larger angle, in degrees (default: by the normals of the "
              "file, and 40 where it has none)");
  addPositive(command, "--max-reflectance", options.settings.maxReflectance, 1.0,
              "lower a reflectance of 1 or more to this value (default 0.9999)");
  options.settings.sides = radiosity::Sides::TwoOfSheets;
  const auto addSides = [&](const std::string& name, radiosity::Sides sides, const std::string& help) {
    return command.addFlag(name, help, [&options, sides] { options.settings.sides = sides; });
  };
  const Option two = addSides("--two-sided", radiosity::Sides::Two,
                              "make one surface for each side of a face (default: only for open sheets whose backs are "
                              "lit)");
  addSides("--one-sided", radiosity::Sides::One, "leave the backs of all faces black").excludes(two);
  command.addTexts("--flip", "NAME",
                   "turn the faces of a surface or a group over, so that their backs are fronts (repeatable)",
                   [&options](const std::string& name) { options.settings.flip.push_back(name); });
  addChoice(command, "--emission", options.settings.emission, emissionChoices,
            "unit of Ke, --emit and --lights: radiosity in W/m^2, or radiance in W/(m^2 sr) (default radiosity)");
  addPositive(command.under("Light and reflectance"), "--lumens-per-watt", options.settings.lumensPerWatt,
              std::numeric_limits<double>::infinity(),
              "divide the candela and lux of the lights of a glTF file by X, which gives W/sr and W/m^2 (default 683)");
  addCellOptions(command, options.settings);
  addSymmetryOptions(command, options.settings.symmetry);
  addMaterialOptions(command, options.materials);
}

ordered_json toJson(const radiosity::SceneSettings& settings) {
  ordered_json text{{"charts", nameOf(chartsChoices, settings.charts)},
                    {"crease", settings.crease ? ordered_json(*settings.crease) : ordered_json()},
                    {"max_reflectance", settings.maxReflectance},
                    {"two_sided", settings.sides == radiosity::Sides::Two},
                    {"one_sided", settings.sides == radiosity::Sides::One},
                    {"emission", nameOf(emissionChoices, settings.emission)}};
  if (settings.facets) text["facets"] = true;
  if (!settings.flip.empty()) text["flip"] = settings.flip;
  if (!settings.symmetry.isNone()) text["symmetry"] = toJson(settings.symmetry);
  if (!settings.cellReflectance.empty()) text["cell_reflectance"] = settings.cellReflectance;
  if (!settings.cellEmission.empty()) text["cell_emission"] = settings.cellEmission;
  return text;
}

radiosity::Scene loadedScene(const SceneOptions& options) {
  radiosity::Scene scene =
      withMaterials(radiosity::loadScene(options.file, options.settings), options.materials, options.settings);
  return options.settings.facets ? scene : radiosity::separatedAtWalls(std::move(scene));
}

radiosity::Scene sceneOf(const SceneOptions& options, Console& console) {
  radiosity::Scene scene = loadedScene(options);
  console.warnings(scene.warnings);
  console.detail(std::to_string(scene.surfaces.size()) + " surfaces, " +
                 std::to_string(radiosity::triangleCount(scene)) + " triangles");
  return scene;
}

void requireLight(const radiosity::Scene& scene, const std::filesystem::path& file, const std::string& alternative) {
  if (!radiosity::emitsLight(scene)) {
    const std::vector<std::string> largest = largestFamilies(scene);
    std::string names;
    for (const std::string& name : largest) names += (names.empty() ? "`" : ", `") + name + "`";
    throw raster::InputError(file.string(), 0, "nothing in the scene emits light",
                             "add --emit " + shellQuoted(largest.front() + "=10,10,10") +
                                 " (largest surfaces: " + names + ")" + alternative);
  }
  radiosity::requireEmission(scene, file);
}

void chooseFacets(radiosity::SceneSettings& scene, radiosity::DiscretizationSettings& elements) {
  scene.facets = true;
  if (scene.sides != radiosity::Sides::Two) scene.sides = radiosity::Sides::One;
  elements.isUnburied = true;
  if (!elements.texels && !elements.texelSize) elements.texels = 1;
}

void addDiscretizationOptions(Command command, radiosity::DiscretizationSettings& settings) {
  command = command.under("Elements");
  const Option texels =
      addInteger(command, "--texels", settings.texels, 1, largestTexels,
                 "divide every surface into N x N texels (default: by its size, about 90 texels per surface)");
  addPositive(command, "--texel-size", settings.texelSize, std::numeric_limits<double>::infinity(),
              "divide surfaces into texels of this side, in units of the scene (default: see --texels)")
      .excludes(texels);
  const auto readSurface = [&settings](const std::string& text) {
    const std::size_t equals = text.rfind('=');
    if (equals == std::string::npos || equals == 0) usageError("--surface", "`" + text + "` is not NAME=N");
    settings.surfaceTexels[text.substr(0, equals)] =
        integerOption("--surface", text.substr(equals + 1), 1, largestTexels);
  };
  command.addTexts("--surface", "NAME=N", "divide the surface NAME into N x N texels; 1 means one element (repeatable)",
                   readSurface);
  addInteger(command, "--patch", settings.patch, 1, largestTexels,
             "let N x N elements shoot light together as one patch (default 4)");
}

radiosity::Discretization discretizationOf(const radiosity::DiscretizationSettings& settings,
                                           const radiosity::Scene& scene) {
  for (const auto& [name, texels] : settings.surfaceTexels) radiosity::surfacesNamed(scene, name);
  return radiosity::discretize(scene, settings);
}

ordered_json toJson(const radiosity::DiscretizationSettings& settings) {
  ordered_json surfaceTexels = ordered_json::object();
  // The command line gives square grids only.
  for (const auto& [name, size] : settings.surfaceTexels) surfaceTexels[name] = size.columns;
  return {{"texels", orNull(settings.texels)},
          {"texel_size", orNull(settings.texelSize)},
          {"surface_texels", surfaceTexels},
          {"patch", settings.patches ? ordered_json() : ordered_json(settings.patch)},
          {"patches", orNull(settings.patches)}};
}

void addIdOptions(Command command, radiosity::IdSettings& settings) {
  command = command.under("Item IDs");
  std::vector<std::pair<std::string, std::string>> formats;
  for (const std::string& name : raster::formatNames()) formats.emplace_back(name, name);
  addChoice<std::string>(command, "--format", settings.format, formats,
                         "channels and bits of an item ID (default r8g8b8a8)");
  addChoice(
      command, "--index-maps", settings.indexMaps, indexMapsChoices,
      "use one map per grid size and one offset per surface (shared); one map and one offset per page of many surfaces "
      "(packed); or one map per surface without offsets (unique) (default shared)");
  const auto readPage = [&settings](const std::string& text) {
    settings.page = powerOfTwoOption("--page", text, 1, largestTexels);
  };
  command.addText(
      "--page", "N",
      "let packed pages have N x N texels, a power of two (default 64, or more if the largest surface needs it). With "
      "shared maps, use one map of N x N texels for all surfaces.",
      readPage);
  addChoice(command, "--blend", settings.blend, blendChoices,
            "add offset and index per channel with clamping, as blend units do, or as integers (default clamped-add)");
  command.addFlag("--no-align",
                  "assign offsets without gaps; to compute light or form factors this needs --blend integer-add",
                  [&settings] { settings.aligned = false; });
}

radiosity::IdLayout layoutOf(const radiosity::IdSettings& settings, const radiosity::Discretization& discretization) {
  if (overflows(settings)) throw raster::InputError(overflowText, overflowAdvice);
  return anyLayoutOf(settings, discretization);
}

radiosity::IdLayout shownLayoutOf(const radiosity::IdSettings& settings,
                                  const radiosity::Discretization& discretization, Console& console) {
  const radiosity::IdLayout layout = anyLayoutOf(settings, discretization);
  if (overflows(settings)) console.warning(overflowText + "; " + overflowAdvice);
  return layout;
}

ordered_json toJson(const radiosity::IdSettings& settings) {
  return {{"format", settings.format},
          {"index_maps", nameOf(indexMapsChoices, settings.indexMaps)},
          {"page", orNull(settings.page)},
          {"blend", nameOf(blendChoices, settings.blend)},
          {"align", settings.aligned}};
}

Option addResolution(Command command, int& resolution) {
  const auto read = [&resolution](const std::string& text) { resolution = resolutionOption(text); };
  return command.addText("--resolution", "R",
                         "draw R x R pixels per face of the projection; an even number (default 256)", read);
}

Option addResolutions(Command command, std::vector<int>& resolutions) {
  const auto read = [&resolutions](const std::string& text) { resolutions.push_back(resolutionOption(text)); };
  return command.addTexts(
      "--resolution", "R",
      "draw R x R pixels per face of the hemicube; an even number (repeatable; default 128, 256, 512 and 1024)", read);
}

void addDrawingOptions(Command command, radiosity::DrawingSettings& settings) {
  command = command.under("Form factors");
  addChoice(command, "--discretize", settings.elementsBy, elementsByChoices,
            "draw surfaces with index maps, or cut them into one polygon per element (default texture)");
  addResolution(command, settings.resolution);
  addChoice(
      command, "--orientation", settings.orientation, orientationChoices,
      "rotate projections about the normal, by a different angle per patch (turned) or not at all (aligned); turned "
      "reduces aliasing (default turned)");
  const auto readSplit = [&settings](const std::string& text) {
    settings.split = positiveOption("--split", text, std::numeric_limits<double>::infinity());
    if (settings.split > 1) usageError("--split", "`" + text + "` is above 1, the share of all flux");
  };
  command.addText(
      "--split", "X",
      "subdivide a patch while more than this share of its flux would go elsewhere from other points of it (default "
      "0.003). Bright patches are subdivided further. 1 means no subdivision.",
      readSplit);
  addPositive(
      command, "--pixels-per-element", settings.pixelsPerElement, std::numeric_limits<double>::infinity(),
      "use a coarser index map for a surface that has fewer pixels per visible element than this (default: never). 4 "
      "reduces the aliasing of small elements.");
}

ordered_json toJson(const radiosity::DrawingSettings& settings) {
  return {{"discretize", nameOf(elementsByChoices, settings.elementsBy)},
          {"resolution", settings.resolution},
          {"orientation", nameOf(orientationChoices, settings.orientation)},
          {"split", settings.split},
          {"pixels_per_element", settings.pixelsPerElement}};
}

std::optional<radiosity::ProjectionKind> projectionNamed(const std::string& method) {
  for (const auto& [name, kind] : radiosity::namedProjections())
    if (name == method) return kind;
  return std::nullopt;
}

Option addMethod(Command command, std::string& method, const std::vector<std::string>& others,
                 const std::string& help) {
  Choices<std::string> names;
  for (const auto& projection : radiosity::namedProjections()) names.emplace_back(projection.first, projection.first);
  for (const std::string& other : others) names.emplace_back(other, other);
  return addChoice<std::string>(command, "--method", method, names, help);
}

std::vector<std::string> drawingOptionNames() {
  return {"--discretize", "--resolution", "--orientation", "--pixels-per-element", "--format", "--index-maps", "--page",
          "--blend",      "--no-align",   "--device",      "--device-name"};
}

void refuseUnused(Command command, const std::vector<std::string>& options, const std::string& method) {
  for (const std::string& option : options)
    if (command.isGiven(option)) usageError(option, "is not used with --method " + method + "; omit one of them");
}

}  // namespace hemitex::cli
