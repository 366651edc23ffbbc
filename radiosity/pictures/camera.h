/// The camera of pictures, and the face that draws what it sees.
#pragma once

#include <glm/glm.hpp>

#include "radiosity/scene/scene.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

struct Camera {
  glm::dvec3 eye{0.0};
  glm::dvec3 lookAt{0.0, 0.0, -1.0};
  glm::dvec3 up{0.0, 1.0, 0.0};
  double fov = 50;  ///< degrees, vertical, in (0, 180)
};

/// The face that draws `camera` at width x height pixels (a viewport may be larger than the picture; the scissor is
/// the picture). The largest side is at most 4096. Throws InputError where the camera has no direction, `up` lies
/// along it, or the field of view is out of range. Row 0 of the face is the BOTTOM of the picture. What is nearer than
/// 1e-5 of the scene's extent is clipped.
raster::Face cameraFace(const Scene& scene, const Camera& camera, int width, int height);

}  // namespace hemitex::radiosity
