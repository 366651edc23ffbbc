#include "cli/common/camera_options.h"

#include <array>
#include <limits>

#include "cli/common/json.h"
#include "cli/common/options.h"
#include "radiosity/pictures/default_camera.h"
#include "raster/base/file_io.h"
#include "raster/base/input_error.h"

namespace hemitex::cli {
namespace {

/// Pictures are sampled 2 x 2 a pixel, and a view has at most 4096 samples a side.
constexpr int largestSide = 2048;

std::filesystem::path viewFileOf(const std::filesystem::path& sceneFile) {
  return std::filesystem::path(sceneFile).replace_extension(".view.json");
}

std::optional<glm::dvec3> vectorAt(const nlohmann::json& view, const std::string& key) {
  if (!view.contains(key)) return std::nullopt;
  const auto values = view.at(key).get<std::array<double, 3>>();
  return glm::dvec3(values[0], values[1], values[2]);
}

/// What a view file says, as if it stood on the command line; nothing where there is no such file.
CameraOptions readViewFile(const std::filesystem::path& file) {
  CameraOptions view;
  const std::optional<std::string> text = raster::tryReadFile(file);
  if (!text) return view;
  try {
    const auto json = nlohmann::json::parse(*text);
    view.eye = vectorAt(json, "eye");
    view.lookAt = vectorAt(json, "look_at");
    view.up = vectorAt(json, "up");
    if (json.contains("fov")) view.fov = json.at("fov").get<double>();
  } catch (const nlohmann::json::exception& error) {
    throw raster::InputError(file.string(), 0, std::string("is no view: ") + error.what(),
                             "write {\"eye\": [x,y,z], \"look_at\": [x,y,z], \"up\": [x,y,z], \"fov\": degrees}");
  }
  return view;
}

}  // namespace

void addCameraOptions(Command command, CameraOptions& options) {
  addVectorOption(
      command, "--eye", options.eye,
      "where the camera stands (default: as SCENE.view.json says, else a view of the whole room or object)");
  addVectorOption(command, "--look-at", options.lookAt, "a point in the middle of the picture");
  addVectorOption(command, "--up", options.up, "what is up in the picture");
  addPositive(command, "--fov", options.fov, 180.0, "vertical field of view in degrees");
  const auto readSize = [&options](const std::string& text) {
    const std::size_t cross = text.find('x');
    if (cross == std::string::npos) usageError("--size", "`" + text + "` is not WxH");
    options.width = integerOption("--size", text.substr(0, cross), 1, largestSide);
    options.height = integerOption("--size", text.substr(cross + 1), 1, largestSide);
  };
  command.addText("--size", "WxH", "of the picture in pixels (default 800x600)", readSize);
  addPositive(command, "--exposure", options.exposure, std::numeric_limits<double>::infinity(),
              "factor on radiosity (default: the mean of what does not emit shows as 0.18)");
}

radiosity::Camera cameraOf(const CameraOptions& options, const radiosity::Scene& scene,
                           const std::filesystem::path& sceneFile) {
  const CameraOptions view = readViewFile(viewFileOf(sceneFile));
  const auto eye = options.eye ? options.eye : view.eye;
  const auto lookAt = options.lookAt ? options.lookAt : view.lookAt;
  radiosity::Camera camera = eye && lookAt ? radiosity::Camera{} : radiosity::defaultCamera(scene);
  camera.eye = eye.value_or(camera.eye);
  camera.lookAt = lookAt.value_or(camera.lookAt);
  camera.up = options.up.value_or(view.up.value_or(camera.up));
  camera.fov = options.fov.value_or(view.fov.value_or(camera.fov));
  radiosity::cameraFace(scene, camera, options.width, options.height);  // throws where the camera is no camera
  return camera;
}

nlohmann::ordered_json toJson(const radiosity::Camera& camera) {
  return {
      {"eye", toJson(camera.eye)}, {"look_at", toJson(camera.lookAt)}, {"up", toJson(camera.up)}, {"fov", camera.fov}};
}

}  // namespace hemitex::cli
