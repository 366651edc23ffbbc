/// The camera of pictures, and what it sees: for each sample the triangle and the point on it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

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

/// The view that is shown where none is given: upright, with a field of view of 60 degrees. Of the candidates it is the
/// one with the largest sum, over surfaces, of the square roots of the areas of fronts seen (in 64 x 48 samples),
/// reduced where backs or near objects fill the picture; the first of equals.
/// - Where the scene has a floor (fronts that face up, at one height in its lower half, on a quarter of its plan): at
///   eye height, from 16 places along the floor's border towards its middle.
/// - Where that one has no wall behind, or there is no floor: also from outside, through the four sides and from four
///   corners above; from below only where nothing else shows a front.
/// Up is +y, or +z where a floor fills the scene along z and hardly anything faces +y. Costs at most 29 small pictures
/// of the scene.
Camera defaultCamera(const Scene& scene);

/// The triangles whose backs the eye sees, ascending: pictures leave them out, so that one can look into a closed room.
std::vector<std::uint32_t> trianglesFacingAway(const Scene& scene, const glm::dvec3& eye);

/// What one sample of a picture sees.
struct Visible {
  std::uint32_t surface = 0;
  std::uint32_t triangle = 0;  ///< in Surface::triangles
  glm::dvec3 weights{0.0};     ///< barycentric, of the point on the triangle
};

/// What the samples of a picture see, width x height, row 0 at the TOP; nothing where the background is. Triangles that
/// face away are looked through.
std::vector<std::optional<Visible>> visibleSamples(const Scene& scene, const Camera& camera, int width, int height);

}  // namespace hemitex::radiosity
