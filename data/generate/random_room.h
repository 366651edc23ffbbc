/// Closed rooms of boxes drawn at random: furniture that stands, hangs, hovers, leans and crosses other furniture.
#pragma once

#include <cstdint>

#include "data/generate/model.h"

namespace hemitex::data {

/// Room `seed`, always the same: at most 40 surfaces, 4 to 12 pieces of furniture, one to three lights. All faces of
/// the furniture face outwards. Boxes have all six faces or lack the one that stands on the floor, on another box, or
/// hangs on a wall or the ceiling. Only furniture of one piece crosses: two boxes through each other, and boxes that
/// are sunk a little into the floor or a wall. Nothing comes near the lights. Lengths are in metres.
///
/// No distributions of the standard library and no trigonometric functions are used: both may differ between machines.
Model randomRoom(std::uint32_t seed);

}  // namespace hemitex::data
