/// Shells: the connected parts of a mesh, and which of them enclose a solid or a room.
///
/// Triangles are connected across edges with equal corners. Where more than two meet at an edge, those are connected
/// that bound one wedge behind their fronts, so that solids that touch at an edge stay apart. Parts with borders that
/// share a corner belong together: a box of which one side is divided more finely has such borders.
///
/// Where two neighbours look different ways, the smaller part of the shell counts as turned over, and the shell is what
/// it would be without this mistake.
///
/// A shell is closed if the solid angle that it fills, as seen from points off its faces, is a whole number of spheres
/// (the winding number; Jacobson, Kavan and Sorkine-Hornung 2013, eq. 5).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "radiosity/geometry/mesh_edges.h"

namespace hemitex::radiosity {

/// What a shell is. An open one counts with a cone from its border to the middle of its border.
enum class ShellKind {
  Sheet,  ///< without volume
  Solid,  ///< with fronts outside
  Room    ///< with fronts inside
};

/// By which share the volumes of equal shells differ at most.
inline constexpr double shellVolumeRounding = 1e-6;

struct Shells {
  std::vector<std::uint32_t> ofTriangle;
  std::vector<bool> isTurnedOver;  ///< of each triangle
  std::vector<ShellKind> kinds;    ///< of each shell
  std::vector<double> volumes;     ///< of each shell, negative for rooms
  std::vector<bool> isClosed;      ///< of each shell

  ShellKind kindOf(std::uint32_t triangle) const { return kinds[ofTriangle[triangle]]; }
};

/// Takes n log n time in the number of triangles.
Shells findShells(std::span<const TrianglePositions> triangles);

}  // namespace hemitex::radiosity
