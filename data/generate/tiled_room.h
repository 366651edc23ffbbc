/// A room of any number of surfaces, to measure how time and memory grow.
#pragma once

#include "data/generate/model.h"

namespace hemitex::data {

/// The largest side of a tiled room.
inline constexpr int maxTiles = 1000;

/// A closed room of 16 * tiles^2 square tiles, each a surface: the floor and the ceiling have 2 * tiles x 2 * tiles,
/// the four walls 2 * tiles x tiles. One tile in 10 x 10 of the ceiling emits. A tile is a metre wide. `tiles` is at
/// least 2, so that a tile emits, and at most maxTiles.
Model tiledRoom(int tiles);

}  // namespace hemitex::data
