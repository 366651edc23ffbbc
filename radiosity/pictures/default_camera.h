/// The default view of a scene.
#pragma once

#include <optional>

#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The default view: upright, with a field of view of 60 degrees. It is the candidate with the largest score, the first
/// of equals. The score is the sum, over surfaces, of the square roots of the visible areas of fronts (in 64 x 48
/// samples). It is lower where backs or near objects fill the picture.
/// - If the scene has a floor (fronts that face up, at one height in its lower half, on a quarter of its plan): views
///   at eye height, from 16 places along the floor's border towards its middle.
/// - If the best of these has no wall behind it, or there is no floor: also views from outside, through the four sides
///   and from four corners above. Views from below only if no other view shows a front. Draws at most 29 small
///   pictures of the scene.
/// For `up` see upAxis.
Camera defaultCamera(const Scene& scene, std::optional<int> up = {});

/// The axis of the scene that points up, 1 for y or 2 for z: `given`, else that of the file (see Scene::up). For a file
/// that states none it is z if a floor fills the scene along z and almost nothing faces +y, and otherwise y.
int upAxis(const Scene& scene, std::optional<int> given = {});

}  // namespace hemitex::radiosity
