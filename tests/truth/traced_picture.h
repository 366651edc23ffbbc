/// The picture of a scene by path tracing (Kajiya 1986): only rays, no form factors, item buffers or textures. So it is
/// independent of the pictures of this project, which show the same diffuse surfaces, one-sided faces and lamps.
///
/// A path starts in a pixel, uniformly over its area, and passes through the backs of faces until it meets a front. At
/// each front it adds the light of a random point of the lamps, and goes on in a cosine-distributed direction. A lamp
/// that it meets there counts too; both are weighted by their densities (Veach and Guibas 1995, balance heuristic).
/// Paths end by Russian roulette, at backs and in the background. Lamps that are points, suns and skies are ignored.
#pragma once

#include <cstdint>

#include "radiosity/images/image.h"
#include "radiosity/scene/scene.h"

namespace hemitex::tests {

/// The mean radiosity of each pixel, W/m^2 per band. `side` x `side` paths start in a pixel, in cells of equal area.
/// The same bits for any number of threads.
radiosity::Image tracedPicture(const radiosity::Scene& scene, const radiosity::SceneCamera& camera, int width,
                               int height, int side, std::uint32_t seed = 0);

/// How two pictures differ, in the steps of an 8-bit picture over 255, mean of the bands of a pixel.
struct PictureDifference {
  double mean = 0, of99Percent = 0;  ///< over the pixels; that which 99 % of the pixels do not exceed
};

/// Both have the same size and linear values, which count as an 8-bit file would show them: clamped and sRGB-encoded.
PictureDifference differenceOf(const radiosity::Image& a, const radiosity::Image& b);

}  // namespace hemitex::tests
