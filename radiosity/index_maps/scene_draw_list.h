/// The scene as a draw list: offsets and index maps from the item ID layout, charts as texture coordinates.
#pragma once

#include "radiosity/discretization/discretization.h"
#include "radiosity/index_maps/id_layout.h"
#include "radiosity/scene/scene.h"
#include "raster/interface/draw_list.h"

namespace hemitex::radiosity {

/// The draws of the scene: one a surface, its chart moved to its place in its page, under the shared index map of the
/// page's size or under its own; its back the reserved back item ID. Triangle t of the list is triangle t of the scene.
///
/// A chart that does not fill its page is kept strictly inside its place there, by one binary32 step at least, so that
/// no sample falls on a texel of another surface: a page's side is a power of two, so that the place's borders are
/// binary32 numbers; a sample's coordinates are exact means of the corners' (raster rules, 6); and where clipping makes
/// new corners it rounds to 53 bits, which is less than that step. Inside, page coordinates in binary32 move the
/// borders of texels by 2^-24 of the page's side at most. (At the page's own border there is nobody to fall on.)
raster::DrawList makeDrawList(const Scene& scene, const Discretization& discretization, const IdLayout& layout);

}  // namespace hemitex::radiosity
