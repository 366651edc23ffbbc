/// Pictures of a scene in item IDs: those of Figure 2 in Nielsen and Christensen (2002).
///
/// They draw the draw list of the hemicube from a camera. So they show offsets and index maps after the blend. An index
/// map shows as grey levels, an offset as a hue, and an item ID as the sum of both. So image (c) is (a) + (b), also in
/// the 8-bit codes of the files. Pictures from a camera have width x height pixels; they throw InputError as
/// cameraFace.
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

/// Figure 2 (a): the level of each texel in its index map, or of each element in a unique map.
Image indexMapPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                      const Camera& camera, int width, int height);
/// Figure 2 (b): the hue of each page's offset.
Image offsetPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                    const Camera& camera, int width, int height);
/// Figure 2 (c): each item ID, the sum of both. Backs of blockers are white, the background is black.
Image idPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout, const Camera& camera,
                int width, int height);

/// The item IDs of a clamped add that overflows its channels (Nielsen and Christensen 2002, section 3.2).
struct BlendErrors {
  Image picture;           ///< the picture of index maps; magenta where the blend gives the item ID of another element
  std::size_t pixels = 0;  ///< number of magenta pixels
};
BlendErrors blendErrorPicture(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                              const Camera& camera, int width, int height);

/// Figure 2 (f): an index map of columns x rows, v upwards, each texel texelSide x texelSide pixels.
Image indexMapImage(int columns, int rows, int texelSide);

/// The item IDs of a hemicube, one buffer per face, unfolded to a cross of 2R x 2R pixels. The top face is in the
/// middle, seen along its normal with rows upwards. The four sides are folded down around it, with their horizons
/// outermost.
Image hemicubePicture(const IdLayout& layout, std::span<const raster::Face> faces,
                      std::span<const raster::ItemBuffer> buffers);

/// The item IDs of a projection's faces side by side, one buffer per face, each seen through the face with rows
/// upwards. Pixels without a share are grey.
Image facesPicture(const IdLayout& layout, const Projection& projection, std::span<const raster::Face> faces,
                   std::span<const raster::ItemBuffer> buffers);

}  // namespace hemitex::radiosity
