/// `hemitex vector`: test vectors for the authors of backends. `export` writes the draw list of a scene and the five
/// faces of a hemicube; `render` adds the item buffers by the raster rules. Each other command has its own file.
#include <array>
#include <cmath>
#include <iostream>
#include <limits>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/json.h"
#include "cli/common/staging.h"
#include "cli/common/table.h"
#include "cli/devices/renderers.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/hemicube.h"
#include "radiosity/projection/patch_view.h"
#include "radiosity/projection/projection.h"
#include "raster/base/input_error.h"
#include "reference/trace/stage_dump.h"
#include "reference/vectors/vector_file.h"

namespace hemitex::cli {
namespace {

struct ExportOptions {
  SceneOptions scene;
  radiosity::DiscretizationSettings discretization;
  radiosity::IdSettings id;
  std::string name;
  glm::dvec3 eye{0.0};
  glm::dvec3 normal{0.0};
  glm::dvec3 up{0.0};
  int resolution = 256;
  std::optional<double> nearDistance;
  std::filesystem::path output;
  bool stages = false;
};

/// The sides are named by their directions in a view of the top face with `up` upwards.
constexpr std::array<const char*, 5> faceNames = {"top", "side-right", "side-up", "side-left", "side-down"};

reference::TestVector vectorOf(const ExportOptions& options, Console& console) {
  const radiosity::Scene scene = sceneOf(options.scene, console);
  const radiosity::Discretization discretization = discretizationOf(options.discretization, scene);
  const radiosity::IdLayout layout = layoutOf(options.id, discretization, console);
  const double length = glm::length(options.normal);
  if (!(length > 0) || !std::isfinite(length))
    throw raster::InputError("--normal has no direction; give a vector that is not zero");

  reference::TestVector vector;
  vector.name = options.name.empty() ? options.scene.file.stem().string() : options.name;
  vector.origin = scene.origin;
  vector.list = radiosity::makeDrawList(scene, discretization, layout);
  const double nearDistance = options.nearDistance
                                  ? *options.nearDistance
                                  : radiosity::nearDistance(scene, options.eye, {}, radiosity::hemicubeSquaredReach);
  const auto faces = radiosity::facesOver(radiosity::hemicubeFaces(options.resolution), options.eye - scene.origin,
                                          options.normal / length, options.up, nearDistance);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    raster::validate(faces[f]);
    const std::string name = faceNames[f];
    vector.faces.push_back({name, faces[f], name + ".u32", {}});
  }
  return vector;
}

/// The faces of a vector, as a table.
Table tableOf(const reference::TestVector& vector) {
  const auto row = [&](std::size_t index) -> std::vector<Cell> {
    const reference::VectorFace& face = vector.faces[index];
    return {face.name, std::int64_t{face.face.scissor.width}, std::int64_t{face.face.scissor.height}, face.hash};
  };
  return {{"face", "width", "height", "hash"}, vector.faces.size(), row};
}

void printFaces(const reference::TestVector& vector, const Context& context) {
  if (context.json)
    std::cout << toText({{"name", vector.name}, {"faces", toJson(tableOf(vector))}});
  else
    writeCsv(std::cout, tableOf(vector));
}

void exportVector(const ExportOptions& options, Context& context) {
  const reference::TestVector vector = vectorOf(options, context.console);
  Staging staging(options.output);
  reference::writeVector(staging.folder(), vector, {});
  if (options.stages) reference::writeStages(staging.folder(), vector);
  staging.commit();
  printFaces(vector, context);
}

struct RenderOptions {
  std::filesystem::path input, output;
  Device device = Device::Software;
  bool stages = false;
};

void renderVector(const RenderOptions& options, const Context& context) {
  reference::TestVector vector = reference::readVector(options.input);
  const std::vector<raster::ItemBuffer> buffers = render(*makeRenderer(vector.list, options.device), facesOf(vector));
  for (std::size_t f = 0; f < buffers.size(); ++f) vector.faces[f].hash = reference::idsHash(buffers[f].ids);
  Staging staging(options.output);
  reference::writeVector(staging.folder(), vector, buffers);
  if (options.stages) reference::writeStages(staging.folder(), vector);
  staging.commit();
  printFaces(vector, context);
}

void addStages(Command command, bool& stages) {
  command.addFlag("--stages", stages,
                  "also write the intermediate results between vertices and item IDs (stages.json)");
}

void addExport(Command parent, Context& context) {
  const auto options = std::make_shared<ExportOptions>();
  const Command command = parent.addCommand("export", "Write a scene and the faces of a hemicube as a test vector");
  addSceneOptions(command, options->scene);
  addVectorOption(command, "--eye", options->eye, "position of the eye of the hemicube").required();
  addVectorOption(command, "--normal", options->normal, "direction of the top face").required();
  addVectorOption(command, "--up", options->up, "up direction of the top face (default: derived from the normal)");
  addResolution(command, options->resolution);
  addPositive(command, "--near", options->nearDistance, std::numeric_limits<float>::max(),
              "near distance, in units of the scene (default: one that clips no triangle)");
  command.addText("--name", "TEXT", "name of the vector (default: the name of the scene file)",
                  [options](const std::string& text) { options->name = text; });
  addDiscretizationOptions(command, options->discretization);
  addIdOptions(command, options->id);
  addStages(command, options->stages);
  addOutput(command, options->output, "write the vector into this folder");
  command.onRead([options, &context] { context.command = [options, &context] { exportVector(*options, context); }; });
}

void addRenderVector(Command parent, Context& context) {
  const auto options = std::make_shared<RenderOptions>();
  const Command command = parent.addCommand("render", "Draw the item IDs of a test vector by the raster rules");
  command.addPath("DIR", options->input, "folder of the vector").required();
  addChoice<Device>(command, "--device", options->device,
                    {{"software", Device::Software},
                     {"opengl", Device::OpenGl},
                     {"opengl-fixed-function", Device::OpenGlFixedFunction},
                     {"opengl-plain", Device::OpenGlPlain},
                     {"vulkan", Device::Vulkan}},
                    "draw with this renderer; software follows the raster rules exactly (default software)");
  addStages(command, options->stages);
  addOutput(command, options->output, "write the vector with its item IDs into this folder, which may be DIR");
  command.onRead([options, &context] { context.command = [options, &context] { renderVector(*options, context); }; });
}

}  // namespace

void addVector(Command program, Context& context) {
  const Command command = program.addCommand("vector", "Test vectors for rasterizer backends");
  addExport(command, context);
  addRenderVector(command, context);
  addVectorSuite(command, context);
  addVectorRandom(command, context);
  addVectorCheck(command, context);
  addVectorRun(command, context);
  addVectorExplain(command, context);
  addVectorCalibrate(command, context);
}

}  // namespace hemitex::cli
