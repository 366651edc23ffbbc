/// The scenes that come with the program.
#pragma once

#include <vector>

#include "data/generate/model.h"

namespace hemitex::data {

/// The scene of Nielsen and Christensen 2002, figure 2: a room, a box and a light, 13 quads, each a surface.
Model paperRoom();

/// The Cornell box as measured.
Model cornellBox();

/// A closed room with a pyramid: surfaces that are not rectangles (figure 3 b).
Model pyramidRoom();

/// A closed room whose floor rises to a wave of 5000 triangles with texture coordinates of its own (figure 3 c).
Model curvedRoom();

/// A vaulted hall between a library and a picture gallery, with an apse and a domed round room: 8088 triangles (figure
/// 4).
Model gallery();

/// A closed room with plants of many small leaves, each a surface of its own.
Model plant();

/// A closed room with furniture of boxes that stand on and touch each other.
Model furnishedRoom();

std::vector<Model> allModels();

}  // namespace hemitex::data
