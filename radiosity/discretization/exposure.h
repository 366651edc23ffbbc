/// Exposure: finds the parts of surfaces inside solids, which neither receive nor send light.
///
/// The outline of a solid on a surface cuts the surface's texels into pieces (triangle_slices.h), exactly. Pieces that
/// no outline separates form one region. A region inside a closed solid is buried (isInsideSolid in contacts.h), and so
/// is a surface there that no outline cuts. Solids may lack the face that they stand on. So for other regions the view
/// from a few points decides: a region is buried if the backs that it sees outweigh the fronts of exposed regions that
/// it sees. Surfaces that no outline cuts are looked at if they touch another back to back, like the top of a lamp
/// under a ceiling.
///
/// Contact does not depend on how coordinates are rounded. Distances up to contactTolerance (scene.h) are contact, and
/// the view turns with the surface.
#pragma once

#include <span>
#include <vector>

#include "radiosity/discretization/discretization.h"
#include "radiosity/scene/scene.h"

namespace hemitex::radiosity {

/// The exposure of a surface.
struct Exposure {
  std::vector<CutTexel> cutTexels = {};  ///< ascending; empty if the surface is completely exposed or buried
  bool isBuried = false;                 ///< completely
};

/// The exposure of each surface. `sizes` has the grid size of each surface. In a scene in which all surfaces are
/// two-sided no backs are visible, so that all are exposed.
std::vector<Exposure> findExposure(const Scene& scene, std::span<const GridSize> sizes);

/// The scene with its surfaces separated where solids or sheets stand on them from border to border. A connected part of
/// a surface whose exposed pieces slices separate, such as the floor of two rooms, becomes several surfaces: `floor#1`,
/// `floor#2`, ... with one family and the same chart. So no texel, filter or merged sliver has both sides of a wall. The
/// largest exposed part is the first. What is buried between two parts is halved. A part of less than 1/4096 of the
/// surface is not separated, nor are two-sided surfaces.
Scene separatedAtWalls(Scene scene);

/// The scene without what is inside solids: triangles are cut along outlines, and surfaces that lie completely inside
/// are left out. For surfaces of one element, whose index maps cannot tell what is inside.
Scene withoutBuried(Scene scene);

}  // namespace hemitex::radiosity
