/// The camera of pictures: given on the command line, else in the file SCENE.view.json beside the scene, else one that
/// sees most of the scene; each of eye, look_at, up and fov on its own.
#pragma once

#include <filesystem>
#include <glm/glm.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/common/command_line.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::cli {

struct CameraOptions {
  std::optional<glm::dvec3> eye, lookAt, up;
  std::optional<double> fov;  ///< degrees, in (0, 180)
  int width = 800;            ///< of the picture, in pixels
  int height = 600;
  std::optional<double> exposure;
};
void addCameraOptions(Command command, CameraOptions& options);

/// Throws InputError where the view file is malformed, or the camera has no direction.
radiosity::Camera cameraOf(const CameraOptions& options, const radiosity::Scene& scene,
                           const std::filesystem::path& sceneFile);

/// The camera as a view file holds it.
nlohmann::ordered_json toJson(const radiosity::Camera& camera);

}  // namespace hemitex::cli
