/// Random closed rooms of boxes: furniture that stands, hangs, hovers, leans and intersects other furniture.
#pragma once

#include <cstdint>

#include "data/generate/model.h"

namespace hemitex::data {

/// Room number `seed`, always the same: at most 40 surfaces, 4 to 12 pieces of furniture, one to three lights. All
/// faces of the furniture face outwards. Boxes have all six faces, or lack the face that stands on the floor or on
/// another box, or hangs on a wall or the ceiling. Intersections are only within one piece (two boxes through each
/// other), or of boxes that are sunk a little into the floor or a wall. No furniture is near the lights. Lengths are in
/// metres.
///
/// The function uses neither distributions of the standard library nor trigonometric functions, because both may differ
/// between machines.
Model randomRoom(std::uint32_t seed);

}  // namespace hemitex::data
