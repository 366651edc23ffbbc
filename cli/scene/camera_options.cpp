#include "cli/scene/camera_options.h"

#include <algorithm>
#include <limits>

#include "cli/common/json.h"
#include "cli/common/options.h"
#include "radiosity/pictures/default_camera.h"
#include "radiosity/pictures/visibility.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"
#include "reference/base/json_text.h"

namespace hemitex::cli {
namespace {

/// Pictures have 2 x 2 samples per pixel, more at edges, and a view has at most 4096 samples per side.
constexpr int largestSide = 2048;

std::optional<glm::dvec3> vectorAt(const nlohmann::json& view, const std::string& key) {
  if (!view.contains(key)) return std::nullopt;
  return reference::vectorAt(view, key);
}

/// The camera of a scene file as options; empty options if it has none.
CameraOptions optionsOf(const std::optional<radiosity::SceneCamera>& seen) {
  if (!seen) return {};
  return {.eye = seen->eye, .lookAt = seen->lookAt, .up = seen->up, .fov = seen->fov};
}

/// The camera options of a view file; nothing if the file does not exist.
std::optional<CameraOptions> readViewFile(const std::filesystem::path& file) {
  const std::string form = "write {\"eye\": [x,y,z], \"look_at\": [x,y,z], \"up\": [x,y,z], \"fov\": degrees}";
  const std::optional<std::string> text = raster::tryReadFile(file);
  if (!text) return std::nullopt;
  CameraOptions view;
  try {
    const auto json = reference::parseJson<nlohmann::json>(*text, file.string());
    if (!json.is_object()) throw raster::InputError("it is no JSON object", form);
    view.eye = vectorAt(json, "eye");
    view.lookAt = vectorAt(json, "look_at");
    view.up = vectorAt(json, "up");
    if (json.contains("fov")) view.fov = reference::valueAt<double>(json, "fov");
  } catch (const raster::InputError& error) {
    if (!error.file().empty()) throw;
    throw raster::InputError(file.string(), 0, std::string("is not a valid view: ") + error.what());
  }
  return view;
}

}  // namespace

void addCameraOptions(Command command, CameraOptions& options) {
  command = command.under("Picture");
  addVectorOption(command, "--eye", options.eye,
                  "position of the camera (default: from SCENE.view.json, else from the scene, else a position that "
                  "shows most of it)");
  addVectorOption(command, "--look-at", options.lookAt,
                  "point that is shown in the middle of the picture (default: as for --eye)");
  const auto readUp = [&options](const std::string& text) {
    if (text == "y" || text == "z") options.upAxis = text == "y" ? 1 : 2;
    options.up = text == "y" ? glm::dvec3(0, 1, 0) : text == "z" ? glm::dvec3(0, 0, 1) : parseVector(text);
    if (!options.up) usageError("--up", "`" + text + "` is neither y, z nor a vector x,y,z of three finite numbers");
  };
  command.addText("--up", "y|z|x,y,z",
                  "the axis that points up in the scene, or a direction that points up in the picture (default: from "
                  "SCENE.view.json, else the y axis, or the z axis for an OBJ file whose floor faces it)",
                  readUp);
  addPositive(command, "--fov", options.fov, 180.0,
              "vertical field of view in degrees (default: from SCENE.view.json, else 50)");
  const auto readSize = [&options](const std::string& text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) usageError("--size", "`" + text + "` is not WIDTHxHEIGHT, such as 800x600");
    options.width = integerOption("--size", text.substr(0, cross), 1, largestSide);
    options.height = integerOption("--size", text.substr(cross + 1), 1, largestSide);
  };
  command.addText("--size", "WxH", "width and height of the picture in pixels (default 800x600)", readSize);
  addPositive(
      command, "--exposure", options.exposure, std::numeric_limits<double>::infinity(),
      "factor from radiosity to brightness (default: shows the median of what the camera sees as 0.18, and clips at "
      "most 1 % of the pixels, without lamps)");
}

std::filesystem::path viewFileOf(const std::filesystem::path& sceneFile) {
  return std::filesystem::path(sceneFile).replace_extension(".view.json");
}

radiosity::Camera cameraOf(const CameraOptions& options, const radiosity::Scene& scene,
                           const std::filesystem::path& sceneFile) {
  const CameraOptions view = readViewFile(viewFileOf(sceneFile)).value_or(optionsOf(scene.camera));
  const auto eye = options.eye ? options.eye : view.eye;
  const auto lookAt = options.lookAt ? options.lookAt : view.lookAt;
  const auto up = options.up ? options.up : view.up;
  radiosity::Camera camera = eye && lookAt ? radiosity::Camera{} : radiosity::defaultCamera(scene, options.upAxis);
  camera.eye = eye.value_or(camera.eye);
  camera.lookAt = lookAt.value_or(camera.lookAt);
  camera.up = up.value_or(camera.up);
  camera.fov = options.fov.value_or(view.fov.value_or(camera.fov));
  try {
    radiosity::cameraFace(scene, camera, options.width, options.height);  // throws if the camera is invalid
  } catch (const raster::InputError& error) {
    if (!view.eye && !view.lookAt && !view.up && !view.fov) throw;
    throw raster::InputError(viewFileOf(sceneFile).string(), 0, error.what());
  }
  return camera;
}

std::vector<bool> surfacesSeen(const CameraOptions& options, const radiosity::Scene& scene,
                               const radiosity::Camera& camera) {
  const auto scaled = [longer = std::max(options.width, options.height)](int side) {
    return std::max(1, 256 * side / longer);
  };
  return radiosity::seenSurfaces(scene, camera, scaled(options.width), scaled(options.height));
}

nlohmann::ordered_json toJson(const radiosity::Camera& camera) {
  return {
      {"eye", toJson(camera.eye)}, {"look_at", toJson(camera.lookAt)}, {"up", toJson(camera.up)}, {"fov", camera.fov}};
}

}  // namespace hemitex::cli
