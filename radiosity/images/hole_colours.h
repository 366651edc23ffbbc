/// Colours of the pixels of a map that a cut-out hides.
#pragma once

#include "radiosity/images/cut_out.h"
#include "radiosity/images/image.h"

namespace hemitex::radiosity {

/// Gives each pixel of an image that is a hole the colour of the nearest one that is none, so that filters and means
/// mix no colour that nobody sees. The cut-out covers the image, with as many pixels or others: a pixel of the image is
/// a hole if all of the cut-out in it is. Does nothing if all are holes, if the samplers differ, or if the image is
/// longer than longestGridSide.
void fillHoles(Image& image, const CutOut& cutOut);
void fillHoles(CodedImage& image, const CutOut& cutOut);

}  // namespace hemitex::radiosity
