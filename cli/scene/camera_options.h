/// The camera of pictures. Each of eye, look_at, up and fov comes from the command line, else from the file
/// SCENE.view.json beside the scene, else from the camera in the scene file. If the eye or look_at is still missing, a
/// camera that shows most of the scene is chosen.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "cli/common/command_line.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

struct CameraOptions {
  std::optional<glm::dvec3> eye = {}, lookAt = {}, up = {};
  std::optional<int> upAxis = {};  ///< the axis that points up in the scene: 1 for y, 2 for z
  std::optional<double> fov = {};  ///< degrees, in (0, 180)
  int width = 800, height = 600;   ///< of the picture in pixels
  std::optional<double> exposure = {};
};
void addCameraOptions(Command command, CameraOptions& options);

/// The file beside a scene that may hold its camera.
std::filesystem::path viewFileOf(const std::filesystem::path& sceneFile);

/// The camera for a scene and the options. Throws InputError if the view file is malformed or the camera has no
/// direction.
radiosity::Camera cameraOf(const CameraOptions& options, const radiosity::Scene& scene,
                           const std::filesystem::path& sceneFile);

/// The surfaces that are seen in a picture of these proportions, with 256 pixels along its longer side.
std::vector<bool> surfacesSeen(const CameraOptions& options, const radiosity::Scene& scene,
                               const radiosity::Camera& camera);

/// The camera in the format of a view file.
nlohmann::ordered_json toJson(const radiosity::Camera& camera);

}  // namespace hemitex::cli
