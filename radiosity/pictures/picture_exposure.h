/// The exposure of a picture, chosen from the light that its camera sees. Surfaces out of sight have no effect: neither
/// dark outer walls nor bright ground behind the camera.
#pragma once

#include "radiosity/discretization/discretization.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The factor from `radiosity` in W/m^2 to linear colours in [0, 1], for a picture of width : height. It shows the
/// median of the seen pixels, bands averaged, as middle grey, 0.18 (the key value of Reinhard et al. 2002, Photographic
/// Tone Reproduction). But it is so small that at most 1 % of these pixels are brighter than 1 in a band. The pixels
/// are those of the picture at 256 pixels along its longer side; the radiosity of a pixel is that of its element.
///
/// Pixels of emitting elements, of elements without light and without a surface do not count. If none is left, emitting
/// elements do; if none of these is seen, all elements, once each. Returns 1 if no element has light. Uses only exact
/// selection, sums and quotients, so that the result is equal on all machines. Throws InputError as cameraFace.
double pictureExposure(const Scene& scene, const Discretization& discretization, const ElementValues& radiosity,
                       const Camera& camera, int width, int height);

}  // namespace hemitex::radiosity
