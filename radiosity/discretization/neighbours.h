/// Neighbours in the mesh of a surface: triangles that share an edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

inline constexpr std::uint32_t noNeighbour = 0xffffffff;

/// For each triangle of a surface and each of its corners, the triangle across the edge opposite to the corner, or
/// noNeighbour. Edges are equal if the positions of their corners are. Of more than two triangles at an edge, each has
/// the next one, and the last has the first.
std::vector<std::array<std::uint32_t, 3>> neighbours(const Surface& surface);

/// The corner of `other` opposite to the edge that it shares with `triangle`; that edge is opposite to `corner`.
std::size_t oppositeCorner(const Triangle& triangle, std::size_t corner, const Triangle& other);

}  // namespace hemitex::radiosity
