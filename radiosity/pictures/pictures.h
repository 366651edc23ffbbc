/// Pictures of a scene: as a viewer of OBJ files shows it, unlit, and as the hemicube sees it, in words.
///
/// The views of words are those of Figure 2 in Nielsen and Christensen (2002). They are drawn by the draw list that the
/// hemicube draws, from a camera instead of a patch, so that they show offsets and index maps after they went through
/// the blend. An index map shows as grey levels, an offset as a hue, and a word as the sum of both: image (c) is
/// (a) + (b), in the 8-bit codes of the files too.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <span>

#include "radiosity/discretization/discretize.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/projection/projection.h"
#include "radiosity/scene/image.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/face.h"

namespace hemitex::radiosity {

/// The linear colour of what a sample sees.
using ColourOf = std::function<glm::dvec3(const Visible&)>;

/// A picture of 2 x 2 samples a pixel, averaged in linear light, on black. Sides are at most 2048 pixels. Throws
/// InputError as cameraFace.
Image drawPicture(const Scene& scene, const Camera& camera, int width, int height, const ColourOf& colourOf);

/// What a viewer shows without lights: Kd times map_Kd, bilinear between texel centres and wrapping around, times the
/// interpolated colours of the corners where the file has any (`v x y z r g b`, sRGB-encoded).
glm::dvec3 unlitColour(const Scene& scene, const Visible& visible);

/// The scene in its unlit colours: a solved scene (see writeLitScene) shows its light.
Image unlitPicture(const Scene& scene, const Camera& camera, int width, int height);

/// One value an element, without filtering: a solution as it appears after a one-to-one mapping (Figure 3).
Image elementPicture(const Scene& scene, const Discretization& discretization, const std::vector<glm::dvec3>& values,
                     const Camera& camera, int width, int height);

/// Figure 2 (a): the level of each texel in its index map, or of each element in a unique one.
Image indexMapPicture(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                      const Camera& camera, int width, int height);
/// Figure 2 (b): the hue of each page's offset.
Image offsetPicture(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                    const Camera& camera, int width, int height);
/// Figure 2 (c): each word, the sum of both. Backs of blockers are white, the background is black.
Image wordPicture(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                  const Camera& camera, int width, int height);

/// What a clamped add makes of words that overflow its channels (Nielsen and Christensen 2002, 3.2).
struct BlendErrors {
  Image picture;           ///< the picture of index maps, but magenta where the blend made a word of another element
  std::size_t pixels = 0;  ///< how many are magenta
};
BlendErrors blendErrorPicture(const Scene& scene, const Discretization& discretization, const WordLayout& layout,
                              const Camera& camera, int width, int height);

/// Figure 2 (d): the borders of the file's polygons, hidden lines removed, black on white.
Image wireframePicture(const Scene& scene, const Camera& camera, int width, int height);
/// Figure 2 (e): the same with the borders of elements, where regular meshing would cut the polygons.
Image meshPicture(const Scene& scene, const Discretization& discretization, const Camera& camera, int width,
                  int height);

/// Figure 2 (f): an index map of columns x rows, v upwards, each texel texelSide x texelSide pixels.
Image indexMapImage(int columns, int rows, int texelSide);

/// The words of a hemicube, one buffer a face, unfolded into a cross of 2R x 2R pixels: the top face in the middle, as
/// seen along its normal with its rows upwards, and around it the four sides folded down, their horizons outermost.
Image hemicubePicture(const WordLayout& layout, std::span<const raster::Face> faces,
                      std::span<const raster::ItemBuffer> buffers);

/// The words of a projection's faces side by side, one buffer a face, each as seen by an eye that looks through it, its
/// rows upwards. Pixels without a share are grey.
Image facesPicture(const WordLayout& layout, const Projection& projection, std::span<const raster::Face> faces,
                   std::span<const raster::ItemBuffer> buffers);

}  // namespace hemitex::radiosity
