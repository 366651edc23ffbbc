/// The flux that arrives from outside the scene, from the sky and from suns, and that of lamps that are points.
///
/// The sky is replaced by parallel beams from evenly spread directions. For each beam the scene is drawn in a far,
/// narrow view (parallel_view.h). Each pixel carries the same flux to the element that it shows. A sun is one direction
/// with many views, whose pixels lie between each other. So elements receive light at the resolution of texels, and one
/// drawing serves all elements. The alternative is reciprocity: the share of the background in the row of each patch is
/// the share of the sky that it sees. That needs one row per element, and cannot show a sun (docs/light.md compares
/// both).
///
/// The resolution of the views follows the mean area of the elements. An element much smaller than a pixel would be met
/// by chance. It is lit at its centre instead, by rays to some of the directions (ray_tree.h).
#pragma once

#include <cstddef>

#include "radiosity/base/bands.h"
#include "radiosity/discretization/discretization.h"
#include "radiosity/form_factors/form_factor_row.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/item_buffer_renderer.h"

namespace hemitex::radiosity {

/// The smallest share of light from outside that counts (see OutsideFlux::counted).
inline constexpr double leastCounted = 0.01;

struct OutsideFlux {
  BandTable received = {};  ///< one per element, W; empty if no light comes from outside or from lamps
  Bands onBacks = {};       ///< from outside, absorbed by backs, also by the outer sides of walls; W; empty as above
  // Of lamps, in W per band; empty without them. Of what they emit, elements receive the rest.
  Bands fromLamps = {};
  Bands lost = {};         ///< left the scene or was absorbed by backs
  Bands lostToBacks = {};  ///< part of `lost` that backs absorbed
  /// The share of the light from outside that stays in enclosed places, such as rooms and windows with blinds, at least
  /// leastCounted. The rest is absorbed at once or leaves from roofs and lawns; no other surface changes with it. The
  /// default residual and the weights of patches (patch_subdivision.h) are shares of the light that counts.
  double counted = leastCounted;
};

/// The flux that elements receive from outside, and all that lamps emit, in W per band; empty if there is none.
Bands sumOf(const OutsideFlux& flux);

/// Adds flux of a lamp along its row (see ProjectedFormFactors::ofLamp) to the flux of a number of elements.
void addLamp(OutsideFlux& flux, std::size_t elements, const FormFactorRow& row, const Bands& emitted);

inline constexpr int minDirections = 128;

/// The views of light from outside.
struct OutsideViews {
  int directions = 2048;         ///< to the sky, at least minDirections; a sun has a sixteenth as many views
  double pixelsPerElement = 16;  ///< for an element of mean area that faces the light
};

/// The views of a scene of this number of triangles. Above 5 * 2^24 / directions triangles, the time of a view depends
/// on them more than on pixels. So fewer directions are drawn, at most 5 * 2^24 triangles in all, with more pixels: for
/// a share s of the directions, s^(-3/4) times as many per element. For a city of 200,000 triangles this has about the
/// error of three times as many directions with 16 pixels per element, and half the time (docs/light.md).
OutsideViews affordableViews(int directions, std::size_t triangles);

/// The flux from `scene.outside`. `renderer` draws the scene (see sceneRenderer); if the scene has images, with item
/// IDs of no element (see drawListWithBlockers), because only the flux of the first instance counts. Throws InputError
/// for a sun that lights the images behind a mirror in another way than the surfaces.
OutsideFlux outsideFlux(const Scene& scene, const Discretization& discretization, const IdLayout& layout,
                        raster::ItemBufferRenderer& renderer, const OutsideViews& views);

}  // namespace hemitex::radiosity
