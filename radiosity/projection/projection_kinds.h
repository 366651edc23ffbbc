/// The kinds of projections.
#pragma once

#include "radiosity/projection/projection.h"

namespace hemitex::radiosity {

enum class ProjectionKind { Hemicube, SinglePlane, CubicTetrahedron };

/// The projection of a kind with faces of resolution x resolution pixels, even, 2 to 4096 (see hemicube.h,
/// single_plane.h, cubic_tetrahedron.h).
Projection projectionOf(ProjectionKind kind, int resolution);

}  // namespace hemitex::radiosity
