/// `hemitex vector export` writes the draw list of a scene and the five faces of a hemicube as a test vector.
#include <array>
#include <cmath>
#include <limits>
#include <memory>

#include "cli/common/commands.h"
#include "cli/common/staging.h"
#include "cli/scene/scene_options.h"
#include "cli/vector/vector_output.h"
#include "radiosity/index_maps/scene_draw_list.h"
#include "radiosity/projection/patch_view.h"
#include "radiosity/projection/projection.h"
#include "radiosity/projection/projection_kinds.h"
#include "raster/base/input_error.h"
#include "reference/conformance/trace/stage_dump.h"

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
  const radiosity::IdLayout layout = shownLayoutOf(options.id, discretization, console);
  const double length = glm::length(options.normal);
  if (!(length > 0) || !std::isfinite(length))
    throw raster::InputError("--normal has no direction; give a vector that is not zero");

  reference::TestVector vector;
  vector.name = options.name.empty() ? options.scene.file.stem().string() : options.name;
  vector.origin = scene.origin;
  vector.list = radiosity::makeDrawList(scene, discretization, layout);
  const double nearDistance = options.nearDistance
                                  ? *options.nearDistance
                                  : radiosity::nearDistance(scene, radiosity::triangleBoxes(scene), options.eye, {},
                                                            radiosity::hemicubeSquaredReach);
  const auto faces = radiosity::facesOver(radiosity::hemicubeFaces(options.resolution), options.eye - scene.origin,
                                          options.normal / length, options.up, nearDistance);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    raster::validate(faces[f]);
    const std::string name = faceNames[f];
    vector.faces.push_back({name, faces[f], name + ".u32", {}});
  }
  return vector;
}

void exportVector(const ExportOptions& options, Context& context) {
  const reference::TestVector vector = vectorOf(options, context.console);
  Staging staging({.place = options.output, .writer = "vector export", .inputs = context.inputs()});
  staging.requirePlaces({"vector.json", "stages.json"});
  reference::writeVector(staging.folder(), vector, {});
  if (options.stages) reference::writeStages(staging.folder(), vector);
  staging.commit();
  printFaces(vector, context);
}

}  // namespace

void addVectorExport(Command vector, Context& context) {
  const auto options = std::make_shared<ExportOptions>();
  const Command command = vector.addCommand("export", "Write a scene and the faces of a hemicube as a test vector");
  const Command written = command.under("Vector");
  addVectorOption(written, "--eye", options->eye, "position of the eye of the hemicube").required();
  addVectorOption(written, "--normal", options->normal, "direction of the top face").required();
  addVectorOption(written, "--up", options->up, "up direction of the top face (default: derived from the normal)");
  addResolution(written, options->resolution);
  addPositive(written, "--near", options->nearDistance, std::numeric_limits<float>::max(),
              "near distance, in units of the scene (default: one that clips no triangle)");
  written.addText("--name", "TEXT", "name of the vector (default: the name of the scene file)", options->name);
  addDiscretizationOptions(command, options->discretization);
  addIdOptions(command, options->id);
  addStages(written, options->stages);
  addOutput(written, options->output, "write the vector into this folder");
  addSceneOptions(command, options->scene);
  command.showFirst({"--output", "--eye", "--normal", "--up", "--resolution", "--near", "--name", "--stages",
                     "--texels", "--format"});
  command.addExamples({"data/cornell-box.obj --eye 278,273,280 --normal 0,1,0 -o vector",
                       "data/cornell-box.obj --eye 278,548,280 --normal 0,-1,0 --resolution 64 --stages -o vector"});
  command.onRead([options, &context] { context.command = [options, &context] { exportVector(*options, context); }; });
}

}  // namespace hemitex::cli
