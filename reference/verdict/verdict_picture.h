/// A verdict as a picture.
#pragma once

#include "radiosity/images/image.h"
#include "reference/verdict/verdict.h"

namespace hemitex::reference {

/// A row a face: what was expected, what was found (a colour for each item ID, black for `background`), and the
/// verdict: grey where exact, blue for coverage, green for a texel, yellow for depth, violet for loose clipping, red
/// for errors.
radiosity::Image toPicture(const Verdict& verdict, raster::ItemId background);

}  // namespace hemitex::reference
