/// The camera of pictures, and the face that draws its view.
#pragma once

#include <glm/glm.hpp>

#include "radiosity/scene/scene.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

using Camera = SceneCamera;

/// Unit vectors at right angles: right = forward x up.
struct CameraAxes {
  glm::dvec3 right, up, forward;
};

/// Throws InputError if the camera has no direction, or `up` is parallel to it.
CameraAxes axesOf(const Camera& camera);

/// The tangent of an angle in degrees, in [0, 90), with a relative error of at most 1e-14; without libm, whose last
/// digits differ between machines.
double tangentOfDegrees(double degrees);

/// The face that draws the view of `camera` at width x height pixels, each at most 4096. The viewport may be larger
/// than the picture, which is the scissor rectangle. Row 0 is the BOTTOM of the picture. Surfaces nearer than 1e-5 of
/// the scene's extent are clipped. Throws InputError as axesOf, and if the size or the field of view is out of range.
raster::Face cameraFace(const Scene& scene, const Camera& camera, int width, int height);

}  // namespace hemitex::radiosity
