/// Pictures of a scene as the hemicube sees it, in item IDs: those of Figure 2 in Nielsen and Christensen (2002).
///
/// They are drawn by the draw list that the hemicube draws, from a camera instead of a patch, so that they show offsets
/// and index maps after they went through the blend. An index map shows as grey levels, an offset as a hue, and an item
/// ID as the sum of both: image (c) is (a) + (b), in the 8-bit codes of the files too.
#pragma once

#include <cstddef>
#include <span>

#include "radiosity/discretization/discretization.h"
#include "radiosity/images/image.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/pictures/camera.h"
#include "radiosity/projection/projection.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/face.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// Figure 2 (a): the level of each texel in its index map, or of each element in a unique one.
Image indexMapPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                      const Camera& camera, int width, int height);
/// Figure 2 (b): the hue of each page's offset.
Image offsetPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                    const Camera& camera, int width, int height);
/// Figure 2 (c): each item ID, the sum of both. Backs of blockers are white, the background is black.
Image idPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout, const Camera& camera,
                int width, int height);

/// What a clamped add makes of item IDs that overflow its channels (Nielsen and Christensen 2002, 3.2).
struct BlendErrors {
  Image picture;  ///< the picture of index maps, but magenta where the blend made an item ID of another element
  std::size_t pixels = 0;  ///< how many are magenta
};
BlendErrors blendErrorPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                              const Camera& camera, int width, int height);

/// Figure 2 (f): an index map of columns x rows, v upwards, each texel texelSide x texelSide pixels.
Image indexMapImage(int columns, int rows, int texelSide);

/// The item IDs of a hemicube, one buffer a face, unfolded into a cross of 2R x 2R pixels: the top face in the middle,
/// as seen along its normal with its rows upwards, and around it the four sides folded down, their horizons outermost.
Image hemicubePicture(const IdLayout& layout, std::span<const raster::Face> faces,
                      std::span<const raster::ItemBuffer> buffers);

/// The item IDs of a projection's faces side by side, one buffer a face, each as seen by an eye that looks through it,
/// its rows upwards. Pixels without a share are grey.
Image facesPicture(const IdLayout& layout, const Projection& projection, std::span<const raster::Face> faces,
                   std::span<const raster::ItemBuffer> buffers);

}  // namespace hemitex::radiosity
