/// The view of a scene that is shown where none is given.
#pragma once

#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

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

}  // namespace hemitex::radiosity
