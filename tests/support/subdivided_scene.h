/// Subdivides a scene into more triangles, to measure the time per triangle. Surfaces, charts and materials stay the
/// same, so that elements also stay the same.
#pragma once

#include <cstddef>

#include "radiosity/scene/scene.h"

namespace hemitex::tests {

/// Bisects the longest edge repeatedly, until the scene has at least `triangles` triangles. An edge is bisected in all
/// triangles that share it, so that no vertex lies on an edge of a neighbour; the result may have a few more triangles.
/// Both halves replace the triangle in the list, so that consecutive triangles are neighbours. New chart coordinates
/// are rounded to multiples of 2^-24, as Triangle::chart requires. A scene with more triangles stays unchanged.
radiosity::Scene finerScene(const radiosity::Scene& scene, std::size_t triangles);

}  // namespace hemitex::tests
