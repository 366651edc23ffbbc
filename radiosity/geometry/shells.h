/// Shells: the connected parts of a mesh, and which of them enclose a solid or a room.
///
/// Triangles are connected across edges with equal corners. Where more than two meet at an edge, those are connected
/// that bound one wedge behind their fronts, so that solids that touch at an edge stay apart. Parts with borders that
/// share a corner belong together: a box of which one side is divided more finely has such borders.
///
/// A shell is closed if the solid angle that it fills, as seen from points off its faces, is a whole number of spheres
/// (the winding number; Jacobson, Kavan and Sorkine-Hornung 2013, eq. 5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/geometry/mesh_edges.h"

namespace hemitex::radiosity {

enum class ShellKind {
  Sheet,  ///< open, or without volume
  Solid,  ///< closed, with fronts outside
  Room    ///< closed, with fronts inside
};

struct Shells {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<ShellKind> kinds;  ///< of each shell

  ShellKind kindOf(std::uint32_t triangle) const { return kinds[ofTriangle[triangle]]; }
};

/// Takes n log n time in the number of triangles.
Shells findShells(std::span<const TrianglePositions> triangles);

}  // namespace hemitex::radiosity
