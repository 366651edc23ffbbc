/// A verdict as a picture.
#pragma once

#include "radiosity/images/image.h"
#include "reference/conformance/verdict/verdict.h"

namespace hemitex::reference {

/// One row of pictures per face: expected item IDs, found item IDs (a colour per item ID, black for `background`), and
/// verdicts. Verdicts are grey (exact), blue (coverage), green (texel), yellow (depth), violet (loose clipping) and red
/// (error).
radiosity::Image toPicture(const Verdict& verdict, raster::ItemId background);

}  // namespace hemitex::reference
