/// Joins the pieces of an element that form one convex polygon. Closed forms take time per pair of pieces, and long for
/// pairs that touch, so that one polygon is much faster than its triangles.
#pragma once

#include "reference/truth/closed_forms/surface_pieces.h"

namespace hemitex::reference {

/// The pieces, but for elements that lie in one plane within 1e-12 of the scene's extent and have a convex outline:
/// these get one piece, whose corners are those of the outline, and which has no corners on the chart. It has the area
/// of the others within 1e-11 of it. Where neighbours do not share whole edges, pieces stay as they are.
SurfacePieces mergedPieces(const SurfacePieces& pieces);

/// A surface as convex polygons in the frame of the scene: one where its triangles form one of up to seven corners,
/// else its triangles with area.
using ConvexPolygons = std::vector<std::vector<glm::dvec3>>;
ConvexPolygons convexPolygons(const radiosity::Scene& scene, const radiosity::Surface& surface);
/// Those of each surface.
std::vector<ConvexPolygons> convexPolygons(const radiosity::Scene& scene);
/// The polygons at an instance of the scene.
ConvexPolygons placed(const radiosity::Scene& scene, const ConvexPolygons& polygons,
                      const radiosity::Instance& instance);

}  // namespace hemitex::reference
