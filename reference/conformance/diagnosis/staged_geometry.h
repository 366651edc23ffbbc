/// The geometry stages of a simulated device (staged_device.h): vertex transformation, clipping and snapping.
///
///     position -> clip coordinates (x, y, z, w) -> polygon -> fan of triangles on the sub-pixel grid
///
/// The near plane is z = 0, and z = w - n by the rules.
#pragma once

#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "raster/interface/draw_list.h"
#include "raster/interface/face.h"
#include "reference/conformance/verdict/triangle_bounds.h"

namespace hemitex::reference {

/// A vertex in clip coordinates.
struct ClipVertex {
  glm::dvec4 position;  ///< x, y, z, w
  glm::dvec2 texcoord;
};

/// A convex polygon; it may be empty.
using ClipPolygon = std::vector<ClipVertex>;

/// The part of a polygon where dot(plane, position) >= 0.
ClipPolygon clipAt(const glm::dvec4& plane, const ClipPolygon& polygon);

/// Clips at |x| = size w and |y| = size w.
ClipPolygon clipAtSides(double size, ClipPolygon polygon);

/// The defaults are the raster rules.
struct StagedGeometry {
  /// The clip coordinates of a position.
  std::function<glm::dvec4(const raster::Face&, const glm::vec3&)> transform;

  std::function<ClipPolygon(const ClipPolygon&)> clip;

  /// The grid position of a position in sub-pixels.
  std::function<double(double)> snap;

  StagedGeometry();
};

/// The triangles of a list in draw order, without reach.
std::vector<DeviceTriangle> placeTriangles(const StagedGeometry& geometry, const raster::DrawList& list,
                                           const raster::Face& face);

}  // namespace hemitex::reference
