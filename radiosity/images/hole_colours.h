/// Colours of the pixels of a map that a cut-out hides.
#pragma once

#include "radiosity/images/cut_out.h"
#include "radiosity/images/image.h"

namespace hemitex::radiosity {

/// Gives each pixel of an image that is a hole the colour of the nearest one that is none, so that filters and means
/// have no hidden colours. The cut-out may have other pixels than the image. A pixel of the image is a hole if the
/// cut-out has only holes there. Does nothing if all are holes, if the samplers differ, or if the image is longer than
/// longestGridSide.
void fillHoles(Image& image, const CutOut& cutOut);
void fillHoles(CodedImage& image, const CutOut& cutOut);

}  // namespace hemitex::radiosity
