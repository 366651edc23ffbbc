/// A picture whose pixels gather their light: that of a path tracer without its noise.
///
/// The points that pixels show are lit as texels are (final_gather.h). A hemicube over a point shows elements of the
/// solution; few points have one, and the others are interpolated where the picture has no edge. Direct light is
/// computed at each point. Between points it is interpolated in the parts of the picture that belong together. Samples
/// that no point belongs to have light of their own. Curved surfaces have the light of their texels.
#pragma once

#include <cstddef>

#include "radiosity/gather/final_gather.h"
#include "radiosity/pictures/camera.h"

namespace hemitex::radiosity {

struct GatheredPicture {
  Image image;
  std::size_t pixels = 0;  ///< that show a surface in their middle
  std::size_t drawn = 0;   ///< hemicubes
  double error = 0;        ///< of interpolated pixels; see GatheredLight
};

/// Draws width x height pixels as drawPicture: the radiosity in W/m^2 times `exposure`, in front of `background`. A
/// pixel is the mean of linear values, also of those above 1, as in a camera: it is white if a small part of it shows a
/// lamp. `layout` is that of the discretization. Throws InputError as drawPicture.
GatheredPicture gatheredPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                                const Solution& solution, const Camera& camera, int width, int height, double exposure,
                                const glm::dvec3& background = glm::dvec3(0), const GatherSettings& settings = {},
                                const GatherProgress& progress = {});

}  // namespace hemitex::radiosity
